(** * The twist: existence and uniqueness of the normal form up to O(4)

    Without resonance of order one to four there is a normal form, and in all of them

      tau = Im omega (Im k21 + 3 |k20|^2 g(Theta) + |k02|^2 g(3 Theta)). *)

From Coq Require Import Reals Lra Lia ZArith.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Order Jet Complex Symplectic Formal Frame Birkhoff NormalForm.

Open Scope R_scope.

(** A real polynomial in z and its conjugate. *)

Definition jcx (j : jet R) : jet C :=
  Jet (RtoC (c00 j)) (c10 j / 2, - c01 j / 2) (c10 j / 2, c01 j / 2)
    ((c20 j - c02 j) / 4, - c11 j / 4) ((c20 j + c02 j) / 2, 0) ((c20 j - c02 j) / 4, c11 j / 4)
    ((c30 j - c12 j) / 8, (c03 j - c21 j) / 8) ((3 * c30 j + c12 j) / 8, (- c21 j - 3 * c03 j) / 8)
    ((3 * c30 j + c12 j) / 8, (c21 j + 3 * c03 j) / 8) ((c30 j - c12 j) / 8, (c21 j - c03 j) / 8).

Lemma jcx_is : forall j a b, cevZ (jcx j) a b = RtoC (ev j a b).
Proof.
  intros j a b. unfold jcx, cevZ, cev, cp1, cp2, cp3, zeta, ev. apply C_eq; simpl; field.
Qed.

Section Twist.

Variables (X V : R -> R -> R) (x v : R) (jx jv : jet R).
Variables Theta wr wi : R.
Hypothesis expands_X : expands X x v jx.
Hypothesis expands_V : expands V x v jv.
Hypothesis fixed_X : X x v = x.
Hypothesis fixed_V : V x v = v.
Notation cs := (cos Theta).
Notation sn := (sin Theta).
Hypothesis Fr : frame jx jv cs sn wr wi.
Hypothesis Sy : symplectic jx jv.
Hypothesis positive : 0 < wi.
Hypothesis not_1 : cs <> 1.
Hypothesis not_2 : sn <> 0.
Hypothesis not_3 : 2 * cs + 1 <> 0.
Hypothesis not_4 : cs <> 0.

Definition tau1 : R := wi * twist_number jx jv cs sn wr wi.

Lemma i_tau1 : forall sigma : C, (sigma * bar sigma = RtoC wi)%C ->
  (sigma * bar sigma * kappa0 jx jv cs sn wr wi = Ci * RtoC tau1)%C.
Proof.
  intros sigma ->. rewrite (Moeckel jx jv cs sn wr wi Fr Sy). unfold tau1. apply C_eq; simpl; ring.
Qed.

(** ** Uniqueness *)

Theorem twist_unique : forall tau, normal_form X V x v Theta tau -> tau = tau1.
Proof.
  intros tau (h & k & h0 & k0 & Det & Hx & Hv).
  set (J := jplus complex (jcx h) (jscal complex (omega wr wi) (jcx k))).
  assert (J_is : forall a b, (RtoC (ev h a b) + omega wr wi * RtoC (ev k a b) = cevZ J a b)%C).
  { intros a b. rewrite <- !jcx_is. unfold J, cevZ, cev, cp1, cp2, cp3.
    destruct (jcx h), (jcx k). simpl. ring. }
  assert (Co : conjugate (lambda cs sn) (Ci * RtoC tau)%C (kmap jx jv cs sn wr wi) J).
  { apply (normal_form_iff X V x v jx jv Theta wr wi expands_X expands_V fixed_X fixed_V Fr h k J tau
      h0 k0 J_is). split; assumption. }
  assert (Z0 : c00 J = 0%C). { exact (J_0 wr wi h k J h0 k0 J_is). }
  assert (Hl : lambda cs sn <> nu cs sn).
  { intros E. apply (f_equal snd) in E. simpl in E. lra. }
  destruct (solved_of_conjugate (lambda cs sn) (nu cs sn) (Ci * RtoC tau)%C eq_refl
    (lambda_nu jx jv cs sn wr wi Fr) _ _ _ _ _ _ _ J Hl Z0 Co) as [M0 So].
  set (sigma := c10 J) in *.
  assert (Norm : (sigma * bar sigma = RtoC wi)%C).
  { assert (N1 := f_equal fst M0). assert (N2 := f_equal snd M0).
    unfold sigma, J in *. destruct h, k. simpl in *.
    assert (E1 : c10 = wi * c05 - wr * c0) by lra. assert (E2 : c01 = - wi * c0 - wr * c05) by lra.
    rewrite E1, E2 in Det.
    assert (D : wi * (c05 * c05 + c0 * c0) = 1) by lra.
    apply C_eq; simpl. 2: ring. rewrite E1, E2.
    transitivity (wi * (wi * (c05 * c05 + c0 * c0))). field. rewrite D. ring. }
  assert (Ns : sigma <> 0%C).
  { intros E. rewrite E in Norm. apply (f_equal fst) in Norm. simpl in Norm. lra. }
  assert (K := kappa_is jx jv cs sn wr wi Fr not_1 not_3 _ _ _ _ _ Ns So).
  rewrite (i_tau1 sigma Norm) in K. apply (f_equal snd) in K. simpl in K. lra.
Qed.

(** ** Existence *)

Lemma divide : forall x y : C, y <> 0%C -> exists z, (z * y = x)%C.
Proof. intros x' y H. exists (x' / y)%C. field. exact H. Qed.

Theorem twist_exists : normal_form X V x v Theta tau1.
Proof.
  assert (N := f_wi _ _ _ _ _ _ Fr). assert (Q := f_circle _ _ _ _ _ _ Fr).
  set (s := sqrt wi). assert (Es : s * s = wi) by (apply sqrt_sqrt; lra).
  set (sigma := RtoC s).
  assert (Norm : (sigma * bar sigma = RtoC wi)%C) by (rewrite <- Es; apply C_eq; simpl; ring).
  assert (So := solution jx jv cs sn wr wi Fr not_1 not_3 sigma). rewrite (i_tau1 sigma Norm) in So.
  set (A := (k20 jx jv cs sn wr wi * (sigma * sigma) * inv1 cs sn)%C) in *.
  set (B := (k11 jx jv cs sn wr wi * (sigma * bar sigma) * bar (inv1 cs sn))%C) in *.
  set (D := (k02 jx jv cs sn wr wi * (bar sigma * bar sigma) * bar (inv3 cs sn))%C) in *.
  set (l := lambda cs sn) in *. set (m := nu cs sn) in *.
  assert (N2 : (l * l - 1)%C <> 0%C).
  { intros E. assert (E2 := f_equal snd E). assert (E1 := f_equal fst E). simpl in E1, E2.
    assert (cs = 0) by (apply Rmult_eq_reg_r with (2 * sn); lra). contradiction. }
  assert (M2 : (m * m - 1)%C <> 0%C).
  { intros E. assert (E2 := f_equal snd E). simpl in E2.
    assert (cs = 0) by (apply Rmult_eq_reg_r with (2 * sn); lra). contradiction. }
  assert (M4 : (m * m * m * m - 1)%C <> 0%C).
  { intros E. assert (E1 := f_equal fst E). assert (E2 := f_equal snd E). simpl in E1, E2.
    assert (P : cs * (sn * (2 * (cs * cs) - 1)) = 0).
    { replace (2 * (cs * cs) - 1) with (cs * cs - sn * sn) by lra. lra. }
    apply Rmult_integral in P. destruct P as [P | P]. contradiction.
    apply Rmult_integral in P. destruct P as [P | P]. contradiction.
    assert (Q2 : sn * sn = cs * cs) by lra.
    assert (E1' : (cs * cs - sn * sn) * (cs * cs - sn * sn) - 4 * (cs * cs) * (sn * sn) = 1) by lra.
    rewrite Q2 in E1'. assert (0 <= (cs * cs) * (cs * cs)) by (apply Rmult_le_pos; nra). lra. }
  destruct (divide ((1 + 1) * k20 jx jv cs sn wr wi * sigma * A + k11 jx jv cs sn wr wi * sigma * bar D
    + k30 jx jv cs sn wr wi * sigma * sigma * sigma)%C _ N2) as [E HE].
  destruct (divide ((1 + 1) * k20 jx jv cs sn wr wi * sigma * D + k11 jx jv cs sn wr wi
    * (sigma * bar A + B * bar sigma) + (1 + 1) * k02 jx jv cs sn wr wi * bar sigma * bar B
    + k12 jx jv cs sn wr wi * sigma * bar sigma * bar sigma)%C _ M2) as [M HM].
  destruct (divide (k11 jx jv cs sn wr wi * D * bar sigma + (1 + 1) * k02 jx jv cs sn wr wi * bar sigma
    * bar A + k03 jx jv cs sn wr wi * bar sigma * bar sigma * bar sigma)%C _ M4) as [P HP].
  assert (Co := conjugate_of_solved l m (Ci * RtoC tau1)%C eq_refl (lambda_nu jx jv cs sn wr wi Fr)
    _ _ _ _ _ _ _ sigma A B D E M P So HE HM HP).
  set (J := Jet (RtoC 0) sigma (RtoC 0) A B D E (RtoC 0) M P) in *.
  set (h := jre (jscal complex (2 * alpha wr wi)%C J)). set (k := jre (jscal complex (2 * beta wi)%C J)).
  assert (h0 : c00 h = 0) by (simpl; ring). assert (k0 : c00 k = 0) by (simpl; ring).
  assert (J_is : forall a b, (RtoC (ev h a b) + omega wr wi * RtoC (ev k a b) = cevZ J a b)%C).
  { intros a b. unfold h, k. rewrite !jre_is.
    assert (Sc : forall c, cevZ (jscal complex c J) a b = (c * cevZ J a b)%C).
    { intros c. unfold cevZ, cev, cp1, cp2, cp3. destruct J. simpl. ring. }
    rewrite !Sc. generalize (cevZ J a b). intros zeta. apply C_eq; simpl; field; exact N. }
  exists h, k. split. exact h0. split. exact k0. split.
  { unfold h, k, J, sigma. simpl. rewrite <- Es. field. intros Z. rewrite Z in Es. lra. }
  apply (normal_form_iff X V x v jx jv Theta wr wi expands_X expands_V fixed_X fixed_V Fr h k J tau1
    h0 k0 J_is). exact Co.
Qed.

End Twist.
