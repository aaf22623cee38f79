(** * The normal form of a polynomial map, coefficient by coefficient

    A map of the plane in a complex coordinate, up to degree three,

      zeta -> lambda (zeta + k20 zeta^2 + k11 zeta zeta' + ... + k03 zeta'^3),   ' the conjugate,

    is conjugate to z -> lambda z (1 + kappa z z') by zeta = sigma z + A z^2 + B z z' + D z'^2 + ...
    if and only if

      A (lambda - 1) = k20 sigma^2,  B (lambda' - 1) = k11 sigma sigma',  D (lambda'^3 - 1) = k02 sigma'^2,
      sigma kappa = 2 k20 sigma B + k11 (sigma B' + A sigma') + 2 k02 sigma' D' + k21 sigma^2 sigma',

    and three equations for other coefficients of degree three that can always be solved. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Jet Complex.
Open Scope C_scope.

(** The polynomial k(u, w) for two polynomials u, w without constant term. *)

Definition jcomp (k u w : jet C) : jet C :=
  let plus := jplus complex in let mult := jmult complex in let scal := jscal complex in
  plus (plus (scal (c10 k) u) (scal (c01 k) w))
  (plus (plus (plus (scal (c20 k) (mult u u)) (scal (c11 k) (mult u w))) (scal (c02 k) (mult w w)))
  (plus (plus (scal (c30 k) (mult (mult u u) u)) (scal (c21 k) (mult (mult u u) w)))
        (plus (scal (c12 k) (mult (mult u w) w)) (scal (c03 k) (mult (mult w w) w))))).

(** lambda z (1 + kappa z z'), and the map without its factor lambda. *)

Definition jnormal (lambda kappa : C) : jet C := Jet (RtoC 0) lambda 0 0 0 0 0 (lambda * kappa) 0 0.
Definition near_identity (k20 k11 k02 k30 k21 k12 k03 : C) : jet C :=
  Jet (RtoC 0) 1 0 k20 k11 k02 k30 k21 k12 k03.

Definition conjugate (lambda kappa : C) (k j : jet C) : Prop :=
  jscal complex lambda (jcomp k j (jbar j)) =
  jcomp j (jnormal lambda kappa) (jbar (jnormal lambda kappa)).

Lemma Cminus_0 : forall x y : C, x - y = 0 -> x = y.
Proof. intros x y H. replace x with ((x - y) + y) by ring. rewrite H. ring. Qed.

(** The goal is c times the equation H, plus d times the equation U. *)

Ltac linear c H d U := apply Cminus_0; lazymatch type of H with ?l = ?r =>
  lazymatch type of U with ?m = ?n => lazymatch goal with |- ?x - ?y = _ =>
    transitivity (c * (l - r) + d * (m - n)); [ ring | rewrite H, U; ring ] end end end.

Section Coefficients.

Notation bar := Cconj.

Variables lambda nu kappa : C.
Hypothesis conj_lambda : bar lambda = nu.
Hypothesis unimodular : lambda * nu = 1.
Variables k20 k11 k02 k30 k21 k12 k03 : C.
Let k := near_identity k20 k11 k02 k30 k21 k12 k03.

Record solved (sigma A B D : C) : Prop := {
  on_20 : A * (lambda - 1) = k20 * (sigma * sigma);
  on_11 : B * (nu - 1) = k11 * (sigma * bar sigma);
  on_02 : D * (nu * nu * nu - 1) = k02 * (bar sigma * bar sigma);
  on_21 : sigma * kappa = (1 + 1) * k20 * sigma * B + k11 * (sigma * bar B + A * bar sigma)
          + (1 + 1) * k02 * bar sigma * bar D + k21 * sigma * sigma * bar sigma }.

Lemma bar_0 : bar (RtoC 0) = 0.
Proof. apply C_eq; simpl; ring. Qed.

Ltac unfold_conjugate := unfold conjugate, jcomp, jscal, jplus, jmult, jbar, jnormal, k, near_identity.

Lemma conjugate_of_solved : forall sigma A B D E M N, solved sigma A B D ->
  E * (lambda * lambda - 1) = (1 + 1) * k20 * sigma * A + k11 * sigma * bar D + k30 * sigma * sigma * sigma ->
  M * (nu * nu - 1) = (1 + 1) * k20 * sigma * D + k11 * (sigma * bar A + B * bar sigma)
    + (1 + 1) * k02 * bar sigma * bar B + k12 * sigma * bar sigma * bar sigma ->
  N * (nu * nu * nu * nu - 1) = k11 * D * bar sigma + (1 + 1) * k02 * bar sigma * bar A
    + k03 * bar sigma * bar sigma * bar sigma ->
  conjugate lambda kappa k (Jet (RtoC 0) sigma 0 A B D E 0 M N).
Proof.
  intros sigma A B D E M N [H20 H11 H02 H21] H30 H12 H03. unfold_conjugate. simpl.
  rewrite ?conj_mult, ?conj_lambda, ?bar_0.
  f_equal; try ring.
  - linear (- lambda) H20 0 unimodular.
  - linear (- lambda) H11 0 unimodular.
  - linear (- lambda) H02 (nu * nu * D) unimodular.
  - linear (- lambda) H30 0 unimodular.
  - linear (- lambda) H21 0 unimodular.
  - linear (- lambda) H12 0 unimodular.
  - linear (- lambda) H03 (nu * nu * nu * N) unimodular.
Qed.

Lemma solved_of_conjugate : forall j : jet C, lambda <> nu -> c00 j = 0 -> conjugate lambda kappa k j ->
  c01 j = 0 /\ solved (c10 j) (c20 j) (c11 j) (c02 j).
Proof.
  intros j Hl Z0 H. destruct j as [z sigma mu A B D E G M N]. simpl in *. subst z.
  unfold conjugate in H.
  assert (Mu : mu = 0).
  { assert (H01 := f_equal c01 H). revert H01. unfold_conjugate. simpl.
    rewrite ?conj_mult, ?conj_lambda, ?bar_0. intros H01.
    assert (Q : (lambda - nu) * mu = 0).
    { linear (RtoC 1) H01 0 unimodular. }
    destruct (Ceq_dec mu 0) as [Em | Em]. exact Em. exfalso.
    apply (Cmult_neq_0 (lambda - nu) mu) in Q; auto.
    intros Q'. apply Hl, Cminus_0, Q'. }
  subst mu. split. reflexivity.
  assert (H20 := f_equal c20 H). assert (H11 := f_equal c11 H). assert (H02 := f_equal c02 H).
  assert (H21 := f_equal c21 H). clear H.
  revert H20 H11 H02 H21. unfold_conjugate. simpl. rewrite ?conj_mult, ?conj_lambda, ?bar_0.
  intros H20 H11 H02 H21. split.
  - linear (- nu) H20 (- (A * (lambda - 1) - k20 * (sigma * sigma))) unimodular.
  - linear (- nu) H11 (- (B * (nu - 1) - k11 * (sigma * bar sigma))) unimodular.
  - linear (- nu) H02 (k02 * (bar sigma * bar sigma) + D) unimodular.
  - linear (- nu) H21 (- (sigma * kappa - ((1 + 1) * k20 * sigma * B + k11 * (sigma * bar B +
      A * bar sigma) + (1 + 1) * k02 * bar sigma * bar D + k21 * sigma * sigma * bar sigma))
      - lambda * nu * G) unimodular.
Qed.

End Coefficients.
