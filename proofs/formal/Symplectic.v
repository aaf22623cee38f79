(** * What the preservation of area says of the Taylor polynomial

    The derivatives of a smooth function are, to lower order, the derivatives of its polynomial.  So
    if det d(X, V) = 1 around a point, then the determinant of the derivatives of the polynomials is
    1 + O(3) as a polynomial. *)

From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Plane Smooth Order Jet Taylor.
Open Scope R_scope.

(** ** Partial derivatives *)

Lemma D2_partial : forall f x v p q, D2 f x v p q ->
  is_derive (fun s => f s v) x p /\ is_derive (fun s => f x s) v q.
Proof.
  intros f x v p q H. split; apply is_derive_Reals.
  - replace p with (p * 1 + q * 0) by ring.
    apply (derivable_pt_lim_comp_2d f (fun s => s) (fun _ => v)). exact H.
    apply derivable_pt_lim_id. apply derivable_pt_lim_const.
  - replace q with (p * 0 + q * 1) by ring.
    apply (derivable_pt_lim_comp_2d f (fun _ => x) (fun s => s)). exact H.
    apply derivable_pt_lim_const. apply derivable_pt_lim_id.
Qed.

Lemma is_derive_shift : forall (g : R -> R) c a k, is_derive g (c + a) k ->
  is_derive (fun s => g (c + s)) a k.
Proof.
  intros g c a k H. evar_last. apply (is_derive_comp g (fun s => c + s)). exact H.
  auto_derive. exact I. reflexivity. unfold scal; simpl; unfold mult; simpl. ring.
Qed.

Section Shift.

Variables x v : R.
Definition shift (f : R -> R -> R) (a b : R) : R := f (x + a) (v + b).

Lemma shifted : forall P : R -> R -> Prop, locally_2d P x v ->
  exists d, 0 < d /\ forall a b, size a b < d -> P (x + a) (v + b).
Proof.
  intros P [d Hd]. exists d. split. apply cond_pos. intros a b Hs.
  assert (Sa : Rabs a <= size a b) by apply Rmax_l.
  assert (Sb : Rabs b <= size a b) by apply Rmax_r.
  apply Hd. replace (x + a - x) with a by ring. lra. replace (v + b - v) with b by ring. lra.
Qed.

Lemma derivatives_of_D2 : forall f p q, locally_2d (fun a b => D2 f a b (p a b) (q a b)) x v ->
  derivatives (shift f) (shift p) (shift q).
Proof.
  intros f p q H. destruct (shifted _ H) as [d [Hd D]]. exists d. split. exact Hd.
  intros a b Hs. destruct (D2_partial _ _ _ _ _ (D a b Hs)) as [Dp Dq]. unfold shift. split.
  - apply (is_derive_shift (fun s => f s (v + b))). exact Dp.
  - apply (is_derive_shift (fun s => f (x + a) s)). exact Dq.
Qed.

(** ** Taylor's theorem *)

Lemma order_0_of_continuous : forall f, continuity_2d_pt f x v -> order 0 (shift f).
Proof.
  intros f C0. destruct (C0 (mkposreal 1 Rlt_0_1)) as [d Hd]. simpl in Hd.
  destruct (shifted (fun a b => Rabs (f a b - f x v) < 1)) as [e [He H]].
  { exists d. exact Hd. }
  assert (L1 := Rmin_l 1 e). assert (L2 := Rmin_r 1 e). assert (P := Rabs_pos (f x v)).
  exists (Rabs (f x v) + 1), (Rmin 1 e). split. lra. split. apply Rmin_glb_lt; lra.
  split. exact L1. intros a b Hs. assert (Q := H a b ltac:(lra)). unfold shift. simpl.
  replace (f (x + a) (v + b)) with ((f (x + a) (v + b) - f x v) + f x v) by ring.
  eapply Rle_trans. apply Rabs_triang. lra.
Qed.

Theorem Taylor : forall n f, (n <= 4)%nat -> cont_diff n f x v -> exists j, approx n (shift f) j.
Proof.
  induction n as [ | n IH]; intros f Hn H.
  - exists (jconst real 0). apply approx_close with (fun _ _ => 0). apply approx_const.
    apply order_ext with (fun a b => (-1) * shift f a b). intros; ring.
    apply order_scal, order_0_of_continuous. exact (locally_2d_singleton _ _ _ H).
  - destruct H as (p & q & D & P & Q).
    destruct (IH p ltac:(lia) P) as [jp Hp]. destruct (IH q ltac:(lia) Q) as [jq Hq].
    exists (over (shift f 0 0) jp jq).
    apply integrate with (shift p) (shift q); auto. lia. apply derivatives_of_D2, D.
Qed.

End Shift.

(** ** The derivatives of the polynomial are the polynomials of the derivatives *)

Definition swap (j : jet R) : jet R :=
  Jet (c00 j) (c01 j) (c10 j) (c02 j) (c11 j) (c20 j) (c03 j) (c12 j) (c21 j) (c30 j).

Lemma size_swap : forall a b, size a b = size b a.
Proof. intros. apply Rmax_comm. Qed.

Lemma order_swap : forall n f, order n f -> order n (fun a b => f b a).
Proof.
  intros n f (K & d & HK & Hd & Hd1 & H). exists K, d. repeat split; auto.
  intros a b Hs. rewrite size_swap in *. auto.
Qed.

Lemma approx_swap : forall n f j, approx n f j -> approx n (fun a b => f b a) (swap j).
Proof.
  intros n f j H. apply order_ext with (2 := order_swap _ _ H).
  intros. destruct j. unfold swap. unfold_ev. ring.
Qed.

Record derived (j p q : jet R) : Prop := {
  p_00 : c00 p = c10 j; p_10 : c10 p = 2 * c20 j; p_01 : c01 p = c11 j;
  p_20 : c20 p = 3 * c30 j; p_11 : c11 p = 2 * c21 j; p_02 : c02 p = c12 j;
  q_00 : c00 q = c01 j; q_10 : c10 q = c11 j; q_01 : c01 q = 2 * c02 j;
  q_20 : c20 q = c21 j; q_11 : c11 q = 2 * c12 j; q_02 : c02 q = 3 * c03 j }.

Lemma derivatives_swap : forall F P Q, derivatives F P Q ->
  derivatives (fun a b => F b a) (fun a b => Q b a) (fun a b => P b a).
Proof.
  intros F P Q (d & Hd & H). exists d. split. exact Hd. intros a b Hs.
  rewrite size_swap in Hs. destruct (H b a Hs). auto.
Qed.

Lemma derived_of : forall F P Q j p q, derivatives F P Q -> approx 4 F j -> approx 3 P p ->
  approx 3 Q q -> derived j p q.
Proof.
  intros F P Q j p q D HF HP HQ.
  assert (A := integrate 3 F P Q p q (le_n 3) D HP HQ).
  assert (B := integrate 3 _ _ _ _ _ (le_n 3) (derivatives_swap _ _ _ D)
    (approx_swap _ _ _ HQ) (approx_swap _ _ _ HP)).
  assert (E := approx_unique _ _ _ HF A).
  assert (E' := approx_unique _ _ _ (approx_swap _ _ _ HF) B).
  destruct j, p, q. unfold over, swap in *. simpl in *.
  injection E as e0 e1 e2 e3 e4 e5 e6 e7 e8 e9.
  injection E' as f0 f1 f2 f3 f4 f5 f6 f7 f8 f9. split; simpl; lra.
Qed.

(** ** Area *)

(** The terms of degree one, and the term ab of degree two, of the determinant. *)

Record symplectic (x v : jet R) : Prop := {
  s_0 : c10 x * c01 v - c01 x * c10 v = 1;
  s_a : 2 * c20 x * c01 v + c10 x * c11 v - c11 x * c10 v - 2 * c01 x * c20 v = 0;
  s_b : c11 x * c01 v + 2 * c10 x * c02 v - 2 * c02 x * c10 v - c01 x * c11 v = 0;
  s_aa : c10 x * c21 v + 2 * c20 x * c11 v + 3 * c30 x * c01 v
         - c01 x * (3 * c30 v) - c11 x * (2 * c20 v) - c21 x * c10 v = 0;
  s_ab : c10 x * (2 * c12 v) + 2 * c20 x * (2 * c02 v) + c11 x * c11 v + 2 * c21 x * c01 v
         - c01 x * (2 * c21 v) - c11 x * c11 v - 2 * c02 x * (2 * c20 v) - 2 * c12 x * c10 v = 0;
  s_bb : c10 x * (3 * c03 v) + c11 x * (2 * c02 v) + c12 x * c01 v
         - c01 x * c12 v - 2 * c02 x * c11 v - 3 * c03 x * c10 v = 0 }.

Theorem area_symplectic : forall X V x v jx jv, smooth X x v -> smooth V x v ->
  preserves_area X V x v -> expands X x v jx -> expands V x v jv -> symplectic jx jv.
Proof.
  intros X V x v jx jv SX SV Area EX EV.
  destruct (smooth_here _ _ _ SX 4) as (p & q & DX & P & Q).
  destruct (smooth_here _ _ _ SV 4) as (p' & q' & DV & P' & Q').
  destruct (Taylor x v 3 p ltac:(lia) P) as [jp Hp]. destruct (Taylor x v 3 q ltac:(lia) Q) as [jq Hq].
  destruct (Taylor x v 3 p' ltac:(lia) P') as [jp' Hp'].
  destruct (Taylor x v 3 q' ltac:(lia) Q') as [jq' Hq'].
  assert (RX := derived_of _ _ _ _ _ _ (derivatives_of_D2 x v X p q DX) EX Hp Hq).
  assert (RV := derived_of _ _ _ _ _ _ (derivatives_of_D2 x v V p' q' DV) EV Hp' Hq').
  assert (Det : approx 3 (fun a b => shift x v p a b * shift x v q' a b -
      shift x v q a b * shift x v p' a b)
    (jminus real (jmult real jp jq') (jmult real jq jp'))).
  { apply approx_minus; apply approx_mult; auto. }
  assert (One : approx 3 (fun a b => shift x v p a b * shift x v q' a b -
      shift x v q a b * shift x v p' a b) (jconst real 1)).
  { destruct (shifted x v _ (locally_2d_and _ _ _ _ Area (locally_2d_and _ _ _ _ DX DV)))
      as [d [Hd H]].
    apply order_local with (fun _ _ => 0) d. exact Hd. 2: apply order_zero.
    intros a b Hs. destruct (H a b Hs) as [(A & B & C & D & HA & HV & E) [HX' HV']].
    destruct (differentiable_pt_lim_unique _ _ _ _ _ HA) as [U1 U2].
    destruct (differentiable_pt_lim_unique _ _ _ _ _ HX') as [U3 U4].
    destruct (differentiable_pt_lim_unique _ _ _ _ _ HV) as [U5 U6].
    destruct (differentiable_pt_lim_unique _ _ _ _ _ HV') as [U7 U8].
    unfold shift. rewrite <- U3, <- U4, <- U7, <- U8, U1, U2, U5, U6, E. unfold_ev. ring. }
  destruct (approx_unique_low _ _ _ Det One) as (E0 & E1 & E2 & E3 & E4 & E5).
  destruct RX, RV. destruct jp, jq, jp', jq'. simpl in *.
  subst. split; rewrite <- ?E0; lra.
Qed.
