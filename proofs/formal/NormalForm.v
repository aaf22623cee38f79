(** * The normal form exists, and its twist is Moeckel's number

    In the coordinate zeta of Frame.v the map is lambda (zeta + k20 zeta^2 + ...) + O(4), a change of
    coordinates is a polynomial zeta = sigma z + ..., and z exp(i (Theta + tau |z|^2)) is
    lambda z (1 + i tau z z') + O(4).  So the normal form up to O(4) is the identity of polynomials
    of Formal.v; dx dv = dA dB at 0 means |sigma|^2 = Im omega. *)

From Coq Require Import Reals Lra Lia ZArith.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Order Jet Trig Complex Symplectic Formal Frame Birkhoff.

(** ** Compositions *)

Open Scope C_scope.

Lemma capprox_comp : forall J f j, capprox f j ->
  capprox (fun a b => cev J (f a b) (bar (f a b)) - c00 J) (jcomp J j (jbar j)).
Proof.
  intros J f j Hf. assert (Hg := capprox_conj _ _ Hf).
  apply capprox_ext with (fun a b => (c10 J * f a b + c01 J * bar (f a b)) +
    ((c20 J * (f a b * f a b) + c11 J * (f a b * bar (f a b)) + c02 J * (bar (f a b) * bar (f a b))) +
     ((c30 J * (f a b * f a b * f a b) + c21 J * (f a b * f a b * bar (f a b))) +
      (c12 J * (f a b * bar (f a b) * bar (f a b)) + c03 J * (bar (f a b) * bar (f a b) * bar (f a b)))))).
  { intros. unfold cev, cp1, cp2, cp3. ring. }
  unfold jcomp.
  repeat lazymatch goal with
    | |- capprox _ (jplus _ _ _) => apply capprox_plus
    | |- capprox _ (jscal _ _ _) => apply capprox_scal
    | |- capprox _ (jmult _ _ _) => apply capprox_mult
    end; assumption.
Qed.

Open Scope R_scope.

(** A polynomial of order 1 inserted into something of order n. *)

Lemma order_comp : forall n f p q, order n f -> order 1 p -> order 1 q ->
  order n (fun a b => f (p a b) (q a b)).
Proof.
  intros n f p q (K & d & HK & Hd & Hd1 & H) Hp Hq.
  destruct (order_small p d Hp Hd) as [d1 [Hd1' S1]]. destruct (order_small q d Hq Hd) as [d2 [Hd2' S2]].
  destruct Hp as (K1 & e1 & HK1 & He1 & _ & H1). destruct Hq as (K2 & e2 & HK2 & He2 & _ & H2).
  set (e := Rmin (Rmin 1 e1) (Rmin e2 (Rmin d1 d2))).
  assert (He : 0 < e) by (repeat apply Rmin_glb_lt; lra).
  assert (L0 : e <= 1). { eapply Rle_trans. apply Rmin_l. apply Rmin_l. }
  assert (L1 : e <= e1). { eapply Rle_trans. apply Rmin_l. apply Rmin_r. }
  assert (L2 : e <= e2). { eapply Rle_trans. apply Rmin_r. apply Rmin_l. }
  assert (L3 : e <= d1). { eapply Rle_trans. apply Rmin_r. eapply Rle_trans. apply Rmin_r. apply Rmin_l. }
  assert (L4 : e <= d2). { eapply Rle_trans. apply Rmin_r. eapply Rle_trans. apply Rmin_r. apply Rmin_r. }
  exists (K * (K1 + K2) ^ n), e. split. apply Rmult_le_pos. exact HK. apply pow_le. lra.
  split. exact He. split. exact L0. intros a b Hs. assert (S := size_pos a b).
  assert (Q1 := H1 a b ltac:(lra)). assert (Q2 := H2 a b ltac:(lra)).
  rewrite pow_1 in Q1, Q2.
  assert (Sp : size (p a b) (q a b) < d).
  { unfold size. apply Rmax_lub_lt. apply S1. lra. apply S2. lra. }
  eapply Rle_trans. apply H. exact Sp. rewrite Rmult_assoc, <- Rpow_mult_distr.
  apply Rmult_le_compat_l. exact HK. apply pow_incr. split. apply size_pos.
  unfold size at 1. apply Rmax_lub; nra.
Qed.

Lemma order_1_ev : forall j, c00 j = 0 -> order 1 (ev j).
Proof.
  intros j E. apply order_ext with (fun a b => p1 j a b + p2 j a b + p3 j a b).
  { intros. rewrite ev_is, E. ring. }
  apply order_plus. apply order_plus. apply order_p1.
  apply order_weaken with (2 := order_p2 j). lia. apply order_weaken with (2 := order_p3 j). lia.
Qed.

(** ** The rotation by Theta + tau |z|^2 *)

Section Rotation.

Variables Theta tau : R.
Definition turn_angle (a b : R) : R := Theta + tau * (a * a + b * b).
Definition turn_A (a b : R) : R := cos (turn_angle a b) * a - sin (turn_angle a b) * b.
Definition turn_B (a b : R) : R := sin (turn_angle a b) * a + cos (turn_angle a b) * b.

Lemma approx_square : approx 4 (fun a b => tau * (a * a + b * b))
  (Jet 0 0 0 tau 0 tau 0 0 0 0).
Proof. apply approx_exact. intros. unfold_ev. ring. Qed.

Lemma exp_tau : corder 4 (fun a b => (cos (tau * (a * a + b * b)), sin (tau * (a * a + b * b))) -
  (1 + Ci * RtoC tau * (zeta a b * bar (zeta a b))))%C.
Proof.
  assert (Cos := approx_cos _ _ approx_square). assert (Sin := approx_sin _ _ approx_square).
  simpl in Cos, Sin. rewrite sin_0, cos_0 in *.
  split; simpl; [apply order_ext with (2 := Cos) | apply order_ext with (2 := Sin)];
    intros; unfold jcos, jsin, jeven, jodd; unfold_ev; field.
Qed.

Lemma capprox_turn : capprox (fun a b => (turn_A a b, turn_B a b))
  (jnormal (lambda (cos Theta) (sin Theta)) (Ci * RtoC tau)%C).
Proof.
  set (e := fun a b => (cos (tau * (a * a + b * b)), sin (tau * (a * a + b * b))) : C).
  apply capprox_close with (fun a b => lambda (cos Theta) (sin Theta) *
    ((1 + Ci * RtoC tau * (zeta a b * bar (zeta a b))) * zeta a b))%C.
  - apply capprox_exact. intros a b. unfold jnormal, cevZ, cev, cp1, cp2, cp3. simpl. ring.
  - apply corder_ext with (fun a b => RtoC (-1) * (lambda (cos Theta) (sin Theta) *
      ((e a b - (1 + Ci * RtoC tau * (zeta a b * bar (zeta a b)))) * zeta a b)))%C.
    { intros a b. unfold turn_A, turn_B, turn_angle, e. rewrite cos_plus, sin_plus.
      generalize (tau * (a * a + b * b)). intros s.
      apply C_eq; simpl; ring. }
    apply corder_scal, corder_scal. apply corder_weaken with 5%nat. lia.
    exact (corder_mult 4 1 _ _ exp_tau (proj1 corder_Z)).
Qed.

End Rotation.

(** ** The normal form as an identity of polynomials *)

Section NormalForm.

Variables (X V : R -> R -> R) (x v : R) (jx jv : jet R).
Variables Theta wr wi : R.
Hypothesis expands_X : expands X x v jx.
Hypothesis expands_V : expands V x v jv.
Hypothesis fixed_X : X x v = x.
Hypothesis fixed_V : V x v = v.

Notation cs := (cos Theta).
Notation sn := (sin Theta).
Hypothesis Fr : frame jx jv cs sn wr wi.
Notation omega := (omega wr wi).
Notation alpha := (alpha wr wi).
Notation beta := (beta wi).
Notation kmap := (kmap jx jv cs sn wr wi).

Lemma c00_jx : c00 jx = x /\ c00 jv = v.
Proof.
  split.
  - rewrite <- (approx_value 4 _ jx ltac:(lia) expands_X), !Rplus_0_r. exact fixed_X.
  - rewrite <- (approx_value 4 _ jv ltac:(lia) expands_V), !Rplus_0_r. exact fixed_V.
Qed.

Lemma recover : forall (p q : R) (zeta : C), (RtoC p + omega * RtoC q = zeta)%C ->
  RtoC p = (alpha * zeta + bar alpha * bar zeta)%C /\ RtoC q = (beta * zeta + bar beta * bar zeta)%C.
Proof.
  intros p q zeta <-. assert (N := f_wi _ _ _ _ _ _ Fr). split; apply C_eq; simpl; field; exact N.
Qed.

Variables h k : jet R.
Variable J : jet C.
Variable tau : R.
Hypothesis h_0 : c00 h = 0.
Hypothesis k_0 : c00 k = 0.
Hypothesis J_is : forall a b, (RtoC (ev h a b) + omega * RtoC (ev k a b) = cevZ J a b)%C.

Notation A := (turn_A Theta tau).
Notation B := (turn_B Theta tau).
Notation miss_x := (fun a b => X (x + ev h a b) (v + ev k a b) - (x + ev h (A a b) (B a b))).
Notation miss_v := (fun a b => V (x + ev h a b) (v + ev k a b) - (v + ev k (A a b) (B a b))).

Lemma J_0 : c00 J = 0%C.
Proof.
  assert (Q := J_is 0 0). revert Q. unfold ev, cevZ, cev, cp1, cp2, cp3, zeta. rewrite h_0, k_0.
  intros Q. transitivity (c00 J + (c10 J * (0, 0) + c01 J * bar (0, 0)) +
    (c20 J * ((0, 0) * (0, 0)) + c11 J * ((0, 0) * bar (0, 0)) + c02 J * (bar (0, 0) * bar (0, 0))) +
    (c30 J * ((0, 0) * (0, 0) * (0, 0)) + c21 J * ((0, 0) * (0, 0) * bar (0, 0)) +
     c12 J * ((0, 0) * bar (0, 0) * bar (0, 0)) +
     c03 J * (bar (0, 0) * bar (0, 0) * bar (0, 0))))%C.
  apply C_eq; simpl; ring. rewrite <- Q. apply C_eq; simpl; ring.
Qed.

Lemma left_side : capprox (fun a b => RtoC (X (x + ev h a b) (v + ev k a b) - x) +
    omega * RtoC (V (x + ev h a b) (v + ev k a b) - v))%C
  (jscal complex (lambda cs sn) (jcomp kmap J (jbar J))).
Proof.
  destruct c00_jx as [Ex Ev].
  apply capprox_close with (fun a b => lambda cs sn * (cev kmap (cevZ J a b) (bar (cevZ J a b)) - c00 kmap))%C.
  - apply capprox_scal, capprox_comp. apply capprox_exact. reflexivity.
  - assert (Rx := order_comp 4 _ _ _ expands_X (order_1_ev h h_0) (order_1_ev k k_0)).
    assert (Rv := order_comp 4 _ _ _ expands_V (order_1_ev h h_0) (order_1_ev k k_0)).
    set (rx := fun a b => X (x + ev h a b) (v + ev k a b) - ev jx (ev h a b) (ev k a b)).
    set (rv := fun a b => V (x + ev h a b) (v + ev k a b) - ev jv (ev h a b) (ev k a b)).
    apply corder_ext with (fun a b => (- (rx a b + wr * rv a b), - (wi * rv a b)) : C).
    + intros a b. destruct (recover _ _ _ (J_is a b)) as [Ep Eq].
      assert (Co := coordinate jx jv cs sn wr wi Fr _ _ _ Ep Eq). rewrite Ex, Ev in Co.
      change (c00 kmap) with (RtoC 0).
      replace (lambda cs sn * (cev kmap (cevZ J a b) (bar (cevZ J a b)) - RtoC 0))%C
        with (lambda cs sn * cev kmap (cevZ J a b) (bar (cevZ J a b)))%C by ring.
      rewrite <- Co. unfold rx, rv. apply C_eq; simpl; ring.
    + split; simpl.
      * apply order_ext with (fun a b => (-1) * (rx a b + wr * rv a b)). intros; ring.
        apply order_scal, order_plus. exact Rx. apply order_scal, Rv.
      * apply order_ext with (fun a b => (- wi) * rv a b). intros; ring. apply order_scal, Rv.
Qed.

Lemma right_side : capprox (fun a b => RtoC (ev h (A a b) (B a b)) + omega * RtoC (ev k (A a b) (B a b)))%C
  (jcomp J (jnormal (lambda cs sn) (Ci * RtoC tau)%C) (jbar (jnormal (lambda cs sn) (Ci * RtoC tau)%C))).
Proof.
  apply capprox_ext with (fun a b => cev J (A a b, B a b) (bar (A a b, B a b)) - c00 J)%C.
  { intros a b. rewrite J_is, J_0. unfold cevZ, zeta. ring. }
  apply capprox_comp, capprox_turn.
Qed.

Theorem normal_form_iff : (order 4 miss_x /\ order 4 miss_v) <->
  conjugate (lambda cs sn) (Ci * RtoC tau)%C kmap J.
Proof.
  assert (N := f_wi _ _ _ _ _ _ Fr).
  set (l := fun a b => (RtoC (X (x + ev h a b) (v + ev k a b) - x) +
    omega * RtoC (V (x + ev h a b) (v + ev k a b) - v))%C).
  set (r := fun a b => (RtoC (ev h (A a b) (B a b)) + omega * RtoC (ev k (A a b) (B a b)))%C).
  assert (Dl : forall a b, fst (l a b - r a b)%C = miss_x a b + wr * miss_v a b).
  { intros. unfold l, r. simpl. ring. }
  assert (Dr : forall a b, snd (l a b - r a b)%C = wi * miss_v a b).
  { intros. unfold l, r. simpl. ring. }
  assert (L := left_side). assert (R := right_side). fold l in L. fold r in R.
  split.
  - intros [Hx Hv]. unfold conjugate. apply (capprox_unique l). exact L.
    apply capprox_close with (1 := R). split.
    + apply order_ext with (fun a b => (-1) * (miss_x a b + wr * miss_v a b)).
      intros. rewrite <- Dl. simpl. ring. apply order_scal, order_plus. exact Hx. apply order_scal, Hv.
    + apply order_ext with (fun a b => (- wi) * miss_v a b).
      intros. replace (- wi * miss_v a b) with (- (wi * miss_v a b)) by ring. rewrite <- Dr. simpl. ring.
      apply order_scal, Hv.
  - intros E. unfold conjugate in E. rewrite <- E in R.
    assert (D : corder 4 (fun a b => l a b - r a b)%C).
    { apply corder_ext with (2 := corder_minus 4 _ _ L R). intros; ring. }
    destruct D as [D1 D2].
    assert (Hv : order 4 miss_v).
    { apply order_ext with (fun a b => / wi * snd (l a b - r a b)%C).
      intros. rewrite Dr. field. exact N. apply order_scal, D2. }
    split. 2: exact Hv.
    apply order_ext with (fun a b => fst (l a b - r a b)%C + (- wr) * miss_v a b).
    intros. rewrite Dl. ring. apply order_plus. exact D1. apply order_scal, Hv.
Qed.

End NormalForm.
