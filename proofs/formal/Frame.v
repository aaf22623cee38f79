(** * The complex coordinate zeta = x + omega v at an elliptic point

    Let the linear part be ((a, b), (c, d)) with determinant 1 and eigenvalue lambda = cs + i sn.  With
    omega = (lambda - a)/c the coordinate zeta = x + omega v is multiplied by lambda; conversely
    x = 2 Re(alpha zeta), v = 2 Re(beta zeta), alpha = 1/2 + i Re omega/(2 Im omega),
    beta = - i/(2 Im omega).  In this coordinate a map that preserves area has

      k11 = - 2 conj k20,    Re k21 = |k02|^2 - |k20|^2. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Jet Complex Symplectic Formal.

Notation bar := Cconj.

(** ** The linear part in terms of lambda and omega *)

Open Scope R_scope.

Record frame (jx jv : jet R) (cs sn wr wi : R) : Prop := {
  f_circle : cs * cs + sn * sn = 1;
  f_wi : wi <> 0;
  f_a : c10 jx = cs - wr * sn / wi;
  f_b : c01 jx = - (wr * wr + wi * wi) * sn / wi;
  f_c : c10 jv = sn / wi;
  f_d : c01 jv = cs + wr * sn / wi }.

Lemma frame_exists : forall jx jv s, symplectic jx jv ->
  let t := c10 jx + c01 jv in let cs := t / 2 in let sn := s * sqrt (1 - cs * cs) in
  s * s = 1 -> -2 < t < 2 -> c10 jv <> 0 ->
  frame jx jv cs sn ((cs - c10 jx) / c10 jv) (sn / c10 jv).
Proof.
  intros jx jv s Sy t cs sn Hs Ht Hc.
  assert (Q : 0 < 1 - cs * cs) by (unfold cs; nra). assert (P := sqrt_lt_R0 _ Q).
  assert (E : sn * sn = 1 - cs * cs).
  { unfold sn. replace (s * sqrt (1 - cs * cs) * (s * sqrt (1 - cs * cs)))
      with ((s * s) * (sqrt (1 - cs * cs) * sqrt (1 - cs * cs))) by ring.
    rewrite Hs, sqrt_sqrt; lra. }
  assert (N : sn <> 0). { intros Z. rewrite Z in E. lra. }
  assert (D := s_0 _ _ Sy).
  assert (Ed : c01 jv = 2 * cs - c10 jx) by (unfold cs, t; field).
  assert (Eb : c01 jx = (c10 jx * c01 jv - 1) / c10 jv) by (rewrite <- D; field; exact Hc).
  assert (Ew : sn / c10 jv <> 0).
  { unfold Rdiv. apply Rmult_integral_contrapositive_currified. exact N. apply Rinv_neq_0_compat, Hc. }
  split.
  - lra.
  - exact Ew.
  - field. split; assumption.
  - rewrite Eb, Ed. apply Rmult_eq_reg_r with (c10 jv * (sn / c10 jv)).
    2: { apply Rmult_integral_contrapositive_currified; assumption. }
    transitivity ((c10 jx * (2 * cs - c10 jx) - 1) * sn / c10 jv). field. exact Hc.
    transitivity (- ((cs - c10 jx) * (cs - c10 jx) + sn * sn) * sn / c10 jv).
    rewrite E. field. exact Hc. field. split; assumption.
  - field. split; assumption.
  - rewrite Ed. field. split; assumption.
Qed.

Section Frame.

Variables jx jv : jet R.
Variables cs sn wr wi : R.
Hypothesis Fr : frame jx jv cs sn wr wi.

Definition lambda : C := (cs, sn).
Definition nu : C := (cs, - sn).
Definition omega : C := (wr, wi).
Definition alpha : C := (1 / 2, wr / (2 * wi)).
Definition beta : C := (0, - 1 / (2 * wi)).

Lemma lambda_nu : (lambda * nu = 1)%C.
Proof. assert (Q := f_circle _ _ _ _ _ _ Fr). apply C_eq; simpl; lra. Qed.

Lemma alpha_beta : (alpha + omega * beta = 1 /\ bar alpha + omega * bar beta = 0)%C.
Proof.
  assert (N := f_wi _ _ _ _ _ _ Fr). split; apply C_eq; simpl; field; exact N.
Qed.

Open Scope C_scope.

(** ** The other terms *)

Definition term (x v : R) : C := nu * (RtoC x + omega * RtoC v).

Definition k20 : C := term (c20 jx) (c20 jv) * alpha * alpha + term (c11 jx) (c11 jv) * alpha * beta
  + term (c02 jx) (c02 jv) * beta * beta.
Definition k11 : C := term (c20 jx) (c20 jv) * ((1 + 1) * alpha * bar alpha)
  + term (c11 jx) (c11 jv) * (alpha * bar beta + bar alpha * beta)
  + term (c02 jx) (c02 jv) * ((1 + 1) * beta * bar beta).
Definition k02 : C := term (c20 jx) (c20 jv) * bar alpha * bar alpha
  + term (c11 jx) (c11 jv) * bar alpha * bar beta + term (c02 jx) (c02 jv) * bar beta * bar beta.
Definition k30 : C := term (c30 jx) (c30 jv) * alpha * alpha * alpha
  + term (c21 jx) (c21 jv) * alpha * alpha * beta + term (c12 jx) (c12 jv) * alpha * beta * beta
  + term (c03 jx) (c03 jv) * beta * beta * beta.
Definition k21 : C := term (c30 jx) (c30 jv) * ((1 + 1 + 1) * alpha * alpha * bar alpha)
  + term (c21 jx) (c21 jv) * (alpha * alpha * bar beta + (1 + 1) * alpha * bar alpha * beta)
  + term (c12 jx) (c12 jv) * (bar alpha * beta * beta + (1 + 1) * alpha * beta * bar beta)
  + term (c03 jx) (c03 jv) * ((1 + 1 + 1) * beta * beta * bar beta).
Definition k12 : C := term (c30 jx) (c30 jv) * ((1 + 1 + 1) * alpha * bar alpha * bar alpha)
  + term (c21 jx) (c21 jv) * (bar alpha * bar alpha * beta + (1 + 1) * alpha * bar alpha * bar beta)
  + term (c12 jx) (c12 jv) * (alpha * bar beta * bar beta + (1 + 1) * bar alpha * beta * bar beta)
  + term (c03 jx) (c03 jv) * ((1 + 1 + 1) * beta * bar beta * bar beta).
Definition k03 : C := term (c30 jx) (c30 jv) * bar alpha * bar alpha * bar alpha
  + term (c21 jx) (c21 jv) * bar alpha * bar alpha * bar beta
  + term (c12 jx) (c12 jv) * bar alpha * bar beta * bar beta
  + term (c03 jx) (c03 jv) * bar beta * bar beta * bar beta.

Definition kmap : jet C := near_identity k20 k11 k02 k30 k21 k12 k03.

Lemma term_is : forall x v, RtoC x + omega * RtoC v = lambda * term x v.
Proof.
  intros x v. unfold term. replace (lambda * (nu * (RtoC x + omega * RtoC v)))
    with (lambda * nu * (RtoC x + omega * RtoC v)) by ring.
  rewrite lambda_nu. ring.
Qed.

Lemma linear_is : RtoC (c10 jx) + omega * RtoC (c10 jv) = lambda /\
  RtoC (c01 jx) + omega * RtoC (c01 jv) = lambda * omega.
Proof.
  destruct Fr as [Q N -> -> -> ->]. split; apply C_eq; simpl; field; exact N.
Qed.

(** The map in the coordinate: for real p, q with p + omega q = zeta. *)

Theorem coordinate : forall (p q : R) (zeta : C),
  RtoC p = alpha * zeta + bar alpha * bar zeta -> RtoC q = beta * zeta + bar beta * bar zeta ->
  RtoC (ev jx p q - c00 jx) + omega * RtoC (ev jv p q - c00 jv) = lambda * cev kmap zeta (bar zeta).
Proof.
  intros p q zeta Ep Eq. destruct alpha_beta as [AB AB']. destruct linear_is as [L1 L2].
  assert (Split : RtoC (ev jx p q - c00 jx) + omega * RtoC (ev jv p q - c00 jv) =
    (RtoC (c10 jx) + omega * RtoC (c10 jv)) * p + (RtoC (c01 jx) + omega * RtoC (c01 jv)) * q +
    ((RtoC (c20 jx) + omega * RtoC (c20 jv)) * (p * p) + (RtoC (c11 jx) + omega * RtoC (c11 jv)) * (p * q)
     + (RtoC (c02 jx) + omega * RtoC (c02 jv)) * (q * q)) +
    ((RtoC (c30 jx) + omega * RtoC (c30 jv)) * (p * p * p)
     + (RtoC (c21 jx) + omega * RtoC (c21 jv)) * (p * p * q)
     + (RtoC (c12 jx) + omega * RtoC (c12 jv)) * (p * q * q)
     + (RtoC (c03 jx) + omega * RtoC (c03 jv)) * (q * q * q))).
  { unfold ev. apply C_eq; simpl; ring. }
  rewrite Split, L1, L2, !term_is. clear Split L1 L2.
  assert (One : RtoC p + omega * RtoC q = zeta).
  { rewrite Ep, Eq.
    transitivity ((alpha + omega * beta) * zeta + (bar alpha + omega * bar beta) * bar zeta). ring.
    rewrite AB, AB'. ring. }
  replace (lambda * p + lambda * omega * q) with (lambda * zeta) by (rewrite <- One; ring).
  rewrite Ep, Eq. unfold kmap, near_identity, cev, cp1, cp2, cp3. simpl.
  unfold k20, k11, k02, k30, k21, k12, k03. ring.
Qed.

(** ** What the preservation of area says *)

Hypothesis Sy : symplectic jx jv.

Lemma area_2 : k11 = - (1 + 1) * bar k20.
Proof.
  assert (A := s_a _ _ Sy). assert (B := s_b _ _ Sy). destruct Fr as [Q N Ea Eb Ec Ed].
  rewrite Ea, Eb, Ec, Ed in A, B.
  set (wr' := wr) in *.
  apply Cminus_0.
  transitivity (bar alpha * RtoC (2 * c20 jx * (cs + wr * sn / wi) + (cs - wr * sn / wi) * c11 jv
    - c11 jx * (sn / wi) - 2 * (- (wr * wr + wi * wi) * sn / wi) * c20 jv) +
    bar beta * RtoC (c11 jx * (cs + wr * sn / wi) + 2 * (cs - wr * sn / wi) * c02 jv
    - 2 * c02 jx * (sn / wi) - - (wr * wr + wi * wi) * sn / wi * c11 jv)).
  - unfold k11, k20, term, alpha, beta, nu, omega. apply C_eq; simpl; field; exact N.
  - unfold wr' in *. rewrite A, B. apply C_eq; simpl; ring.
Qed.

Definition norm2 (z : C) : R := (fst z * fst z + snd z * snd z)%R.

Lemma norm2_nu : forall z, norm2 (nu * z) = norm2 z.
Proof.
  intros z. assert (Q := f_circle _ _ _ _ _ _ Fr). unfold norm2, nu. simpl.
  transitivity ((cs * cs + sn * sn) * (fst z * fst z + snd z * snd z))%R. ring. rewrite Q. ring.
Qed.

Lemma area_3 : fst k21 = (norm2 k02 - norm2 k20)%R.
Proof.
  assert (A := s_aa _ _ Sy). assert (B := s_ab _ _ Sy). assert (D := s_bb _ _ Sy).
  set (form := fun p q : C => (RtoC (c20 jx) + omega * RtoC (c20 jv)) * p * p
    + (RtoC (c11 jx) + omega * RtoC (c11 jv)) * p * q + (RtoC (c02 jx) + omega * RtoC (c02 jv)) * q * q).
  assert (E20 : k20 = nu * form alpha beta) by (unfold k20, form, term; ring).
  assert (E02 : k02 = nu * form (bar alpha) (bar beta)) by (unfold k02, form, term; ring).
  rewrite E20, E02, !norm2_nu. clear E20 E02.
  destruct Fr as [Q N Ea Eb Ec Ed]. rewrite Ea, Eb, Ec, Ed in A, B, D. clear Ea Eb Ec Ed Q Sy Fr.
  apply Rminus_diag_uniq. symmetry.
  match type of A with ?sa = _ => match type of B with ?sb = _ => match type of D with ?sd = _ =>
    transitivity (/ 2 * (norm2 alpha * sa + (fst alpha * fst beta + snd alpha * snd beta) * sb
      + norm2 beta * sd))%R end end end.
  { rewrite A, B, D. ring. }
  unfold k21, form, term, alpha, beta, nu, omega, norm2. simpl. field. exact N.
Qed.

End Frame.
