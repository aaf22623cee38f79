(** * The first Birkhoff coefficient: Moeckel's formula

    By Formal.v kappa = |sigma|^2 kappa0 with

      kappa0 = k21 + 2 k20 k11/(lambda' - 1) + (|k11|^2 + k20 k11)/(lambda - 1) + 2 |k02|^2/(lambda^3 - 1).

    1/(exp(i x) - 1) = -1/2 + i g(x)/2 with g(x) = sin x/(cos x - 1); if area is preserved, the real
    part of kappa0 is 0, and its imaginary part is

      Im k21 + 3 |k20|^2 g(Theta) + |k02|^2 g(3 Theta). *)

From Coq Require Import Reals Lra ZArith.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Jet Complex Symplectic Formal Frame.

Open Scope C_scope.

Section Birkhoff.

Variables jx jv : jet R.
Variables cs sn wr wi : R.
Hypothesis Fr : frame jx jv cs sn wr wi.
Hypothesis Sy : symplectic jx jv.
Hypothesis not_1 : cs <> 1%R.
Hypothesis not_3 : (2 * cs + 1 <> 0)%R.

Notation lambda := (lambda cs sn).
Notation nu := (nu cs sn).
Notation k20 := (k20 jx jv cs sn wr wi).
Notation k11 := (k11 jx jv cs sn wr wi).
Notation k02 := (k02 jx jv cs sn wr wi).
Notation k30 := (k30 jx jv cs sn wr wi).
Notation k21 := (k21 jx jv cs sn wr wi).
Notation k12 := (k12 jx jv cs sn wr wi).
Notation k03 := (k03 jx jv cs sn wr wi).

(** 1/(lambda - 1) and 1/(lambda^3 - 1). *)

Definition g1 : R := (sn / (cs - 1))%R.
Definition g3 : R := (sn * (2 * cs - 1) / ((cs - 1) * (2 * cs + 1)))%R.
Definition inv1 : C := (- 1 / 2, g1 / 2)%R.
Definition inv3 : C := (- 1 / 2, g3 / 2)%R.

Lemma square_sn : (sn * sn = 1 - cs * cs)%R.
Proof. assert (Q := f_circle _ _ _ _ _ _ Fr). lra. Qed.

Lemma inv1_is : (lambda - 1) * inv1 = 1.
Proof.
  assert (Q := square_sn). apply C_eq; simpl; unfold g1.
  - transitivity ((- (cs - 1) * (cs - 1) - sn * sn) / (2 * (cs - 1)))%R. field. lra.
    rewrite Q. field. lra.
  - field. lra.
Qed.

Lemma inv1_bar : (nu - 1) * bar inv1 = 1.
Proof.
  transitivity (bar ((lambda - 1) * inv1)).
  - rewrite conj_mult. f_equal. apply C_eq; simpl; ring.
  - rewrite inv1_is. apply C_eq; simpl; ring.
Qed.

Lemma inv3_is : (lambda * lambda * lambda - 1) * inv3 = 1.
Proof.
  assert (Q := square_sn). apply C_eq; simpl; unfold g3.
  - transitivity ((- (cs * (cs * cs - 3 * (sn * sn)) - 1) * ((cs - 1) * (2 * cs + 1))
      - (sn * sn) * (3 * cs * cs - sn * sn) * (2 * cs - 1)) / (2 * ((cs - 1) * (2 * cs + 1))))%R.
    field. lra. rewrite Q. field. lra.
  - transitivity (sn * ((cs * (cs * cs - 3 * (sn * sn)) - 1) * (2 * cs - 1)
      - (3 * cs * cs - sn * sn) * ((cs - 1) * (2 * cs + 1))) / (2 * ((cs - 1) * (2 * cs + 1))))%R.
    field. lra. rewrite Q. field. lra.
Qed.

Lemma inv3_bar : (nu * nu * nu - 1) * bar inv3 = 1.
Proof.
  transitivity (bar ((lambda * lambda * lambda - 1) * inv3)).
  - rewrite conj_mult. f_equal. apply C_eq; simpl; ring.
  - rewrite inv3_is. apply C_eq; simpl; ring.
Qed.

Lemma cancel : forall x y u w : C, u * w = 1 -> x * u = y -> x = y * w.
Proof. intros x y u w H <-. transitivity (x * (u * w)). rewrite H. ring. ring. Qed.

(** ** The coefficient *)

Definition kappa0 : C := k21 + (1 + 1) * k20 * k11 * bar inv1
  + (k11 * bar k11 + k20 * k11) * inv1 + (1 + 1) * k02 * bar k02 * inv3.

Lemma kappa_is : forall sigma kappa A B D : C, sigma <> 0 ->
  solved lambda nu kappa k20 k11 k02 k21 sigma A B D -> kappa = sigma * bar sigma * kappa0.
Proof.
  intros sigma kappa A B D Hs [H20 H11 H02 H21].
  apply (cancel _ _ _ _ inv1_is) in H20. apply (cancel _ _ _ _ inv1_bar) in H11.
  apply (cancel _ _ _ _ inv3_bar) in H02.
  assert (EB : bar B = bar k11 * (bar sigma * sigma) * inv1)
    by (rewrite H11, !conj_mult, !conj_conj; reflexivity).
  assert (ED : bar D = bar k02 * (sigma * sigma) * inv3)
    by (rewrite H02, !conj_mult, !conj_conj; reflexivity).
  rewrite EB, ED, H20, H11 in H21.
  assert (E : sigma * kappa = sigma * (sigma * bar sigma * kappa0)).
  { rewrite H21. unfold kappa0. ring. }
  transitivity (/ sigma * (sigma * kappa)). field. exact Hs. rewrite E. field. exact Hs.
Qed.

Lemma solution : forall sigma : C, solved lambda nu (sigma * bar sigma * kappa0) k20 k11 k02 k21 sigma
  (k20 * (sigma * sigma) * inv1) (k11 * (sigma * bar sigma) * bar inv1)
  (k02 * (bar sigma * bar sigma) * bar inv3).
Proof.
  intros sigma. assert (I1 := inv1_is). assert (I1' := inv1_bar). assert (I3' := inv3_bar). split.
  - transitivity (k20 * (sigma * sigma) * ((lambda - 1) * inv1)). ring. rewrite I1. ring.
  - transitivity (k11 * (sigma * bar sigma) * ((nu - 1) * bar inv1)). ring. rewrite I1'. ring.
  - transitivity (k02 * (bar sigma * bar sigma) * ((nu * nu * nu - 1) * bar inv3)). ring.
    rewrite I3'. ring.
  - rewrite !conj_mult, !conj_conj. unfold kappa0. ring.
Qed.

(** The imaginary part. *)

Definition twist_number : R :=
  (snd k21 + 3 * norm2 k20 * g1 + norm2 k02 * g3)%R.

Theorem Moeckel : kappa0 = Ci * RtoC twist_number.
Proof.
  assert (E2 := area_2 jx jv cs sn wr wi Fr Sy). assert (E3 := area_3 jx jv cs sn wr wi Fr Sy).
  unfold kappa0, twist_number. rewrite E2. unfold inv1, inv3.
  revert E3. unfold norm2. generalize k21 k20 k02. intros [p q] [a b] [c d]. simpl. intros ->.
  apply C_eq; simpl; field.
Qed.

End Birkhoff.
