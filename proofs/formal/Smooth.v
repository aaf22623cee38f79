(** * Functions that are n times continuously differentiable around a point

    Sums, products, quotients, sine, cosine and compositions of such functions are such functions,
    by induction on n: the derivatives are sums of products of these and of lower derivatives. *)

From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Plane.
Open Scope R_scope.

(** ** What holds around a point *)

Lemma locally_2d_twice : forall (P : R -> R -> Prop) x v,
  locally_2d P x v -> locally_2d (fun a b => locally_2d P a b) x v.
Proof.
  intros P x v [d H]. exists d. intros a b Ha Hb. apply (ball_in_ball P x v d); assumption.
Qed.

Lemma locally_2d_both : forall (P Q S : R -> R -> Prop) x v,
  locally_2d P x v -> locally_2d Q x v -> (forall a b, P a b -> Q a b -> S a b) ->
  locally_2d S x v.
Proof.
  intros P Q S x v HP HQ I. apply locally_2d_impl with (2 := locally_2d_and _ _ _ _ HP HQ).
  apply locally_2d_forall. intros a b [A B]. auto.
Qed.

Lemma locally_2d_map : forall (P Q : R -> R -> Prop) x v,
  locally_2d P x v -> (forall a b, P a b -> Q a b) -> locally_2d Q x v.
Proof.
  intros P Q x v H I. apply locally_2d_impl with (2 := H). apply locally_2d_forall. exact I.
Qed.

Lemma D2_ext_loc : forall f g x v p q, locally_2d (fun a b => f a b = g a b) x v ->
  D2 f x v p q -> D2 g x v p q.
Proof. intros f g x v p q E. apply differentiable_pt_lim_ext. exact E. Qed.

(** ** At the point itself *)

Lemma smooth_here : forall f x v, smooth f x v -> forall n, cont_diff n f x v.
Proof. intros f x v S. exact (locally_2d_singleton _ _ _ S). Qed.

(** ** Closure *)

Lemma cont_diff_ext : forall n f g x v, locally_2d (fun a b => f a b = g a b) x v ->
  cont_diff n f x v -> cont_diff n g x v.
Proof.
  intros [ | n] f g x v E H; simpl in *.
  - apply (locally_2d_both _ _ _ _ _ (locally_2d_twice _ _ _ E) H).
    intros a b Eab Cab. exact (continuity_2d_pt_ext_loc _ _ _ _ Eab Cab).
  - destruct H as (p & q & D & P & Q). exists p, q. split; [ | auto].
    apply (locally_2d_both _ _ _ _ _ (locally_2d_twice _ _ _ E) D).
    intros a b Eab. apply D2_ext_loc. exact Eab.
Qed.

Lemma cont_diff_0 : forall n f x v, cont_diff n f x v -> cont_diff 0 f x v.
Proof.
  intros [ | n] f x v H; simpl in *. exact H. destruct H as (p & q & D & _).
  apply (locally_2d_map _ _ _ _ D). intros a b. apply D2_continuous.
Qed.

Lemma cont_diff_S : forall n f x v, cont_diff (S n) f x v -> cont_diff n f x v.
Proof.
  induction n as [ | n IH]; intros f x v H.
  - apply (cont_diff_0 1), H.
  - destruct H as (p & q & D & P & Q). exists p, q. auto.
Qed.

Lemma cont_diff_const : forall n c x v, cont_diff n (fun _ _ => c) x v.
Proof.
  induction n as [ | n IH]; intros c x v; simpl.
  - apply locally_2d_forall. intros. apply continuity_2d_pt_const.
  - exists (fun _ _ => 0), (fun _ _ => 0). split; [ | auto].
    apply locally_2d_forall. intros. apply D2_const.
Qed.

Lemma cont_diff_fst : forall n x v, cont_diff n (fun a _ => a) x v.
Proof.
  intros [ | n] x v; simpl.
  - apply locally_2d_forall. intros. apply continuity_2d_pt_id1.
  - exists (fun _ _ => 1), (fun _ _ => 0). split; [ | split; apply cont_diff_const].
    apply locally_2d_forall. intros. apply D2_fst.
Qed.

Lemma cont_diff_snd : forall n x v, cont_diff n (fun _ b => b) x v.
Proof.
  intros [ | n] x v; simpl.
  - apply locally_2d_forall. intros. apply continuity_2d_pt_id2.
  - exists (fun _ _ => 0), (fun _ _ => 1). split; [ | split; apply cont_diff_const].
    apply locally_2d_forall. intros. apply D2_snd.
Qed.

Lemma cont_diff_plus : forall n f g x v, cont_diff n f x v -> cont_diff n g x v ->
  cont_diff n (fun a b => f a b + g a b) x v.
Proof.
  induction n as [ | n IH]; intros f g x v Hf Hg; simpl in *.
  - apply (locally_2d_both _ _ _ _ _ Hf Hg). intros a b. apply continuity_2d_pt_plus.
  - destruct Hf as (p & q & D & P & Q). destruct Hg as (p' & q' & D' & P' & Q').
    exists (fun a b => p a b + p' a b), (fun a b => q a b + q' a b). split; [ | auto].
    apply (locally_2d_both _ _ _ _ _ D D'). intros a b. apply D2_plus.
Qed.

Lemma cont_diff_mult : forall n f g x v, cont_diff n f x v -> cont_diff n g x v ->
  cont_diff n (fun a b => f a b * g a b) x v.
Proof.
  induction n as [ | n IH]; intros f g x v Hf Hg.
  - simpl in *. apply (locally_2d_both _ _ _ _ _ Hf Hg). intros a b. apply continuity_2d_pt_mult.
  - assert (Lf := cont_diff_S _ _ _ _ Hf). assert (Lg := cont_diff_S _ _ _ _ Hg).
    destruct Hf as (p & q & D & P & Q). destruct Hg as (p' & q' & D' & P' & Q').
    exists (fun a b => p a b * g a b + f a b * p' a b), (fun a b => q a b * g a b + f a b * q' a b).
    split; [ | split; apply cont_diff_plus; apply IH; assumption].
    apply (locally_2d_both _ _ _ _ _ D D'). intros a b. apply D2_mult.
Qed.

Lemma cont_diff_scal : forall n c f x v, cont_diff n f x v ->
  cont_diff n (fun a b => c * f a b) x v.
Proof.
  intros n c f x v H. apply (cont_diff_mult n (fun _ _ => c)). apply cont_diff_const. exact H.
Qed.

Lemma cont_diff_sin_cos : forall n f x v, cont_diff n f x v ->
  cont_diff n (fun a b => sin (f a b)) x v /\ cont_diff n (fun a b => cos (f a b)) x v.
Proof.
  induction n as [ | n IH]; intros f x v H.
  - simpl in *. split; apply (locally_2d_map _ _ _ _ H); intros a b Cab.
    + apply (continuity_1d_2d_pt_comp sin f). apply continuity_sin. exact Cab.
    + apply (continuity_1d_2d_pt_comp cos f). apply continuity_cos. exact Cab.
  - destruct (IH f x v (cont_diff_S _ _ _ _ H)) as [Sf Cf]. destruct H as (p & q & D & P & Q).
    split.
    + exists (fun a b => cos (f a b) * p a b), (fun a b => cos (f a b) * q a b).
      split; [ | split; apply cont_diff_mult; assumption].
      apply (locally_2d_map _ _ _ _ D). intros a b. apply (D2_apply sin f). apply is_derive_sin.
    + exists (fun a b => (-1) * sin (f a b) * p a b), (fun a b => (-1) * sin (f a b) * q a b).
      split; [ | split; apply cont_diff_mult; try assumption; apply cont_diff_scal; exact Sf].
      apply (locally_2d_map _ _ _ _ D). intros a b Dab.
      apply D2_ext with (1 := D2_apply cos f a b _ _ _ (is_derive_cos _) Dab). reflexivity.
      ring. ring.
Qed.

Lemma cont_diff_inv : forall n f x v, f x v <> 0 -> cont_diff n f x v ->
  cont_diff n (fun a b => / f a b) x v.
Proof.
  intros n f x v N H.
  assert (Near : locally_2d (fun a b => f a b <> 0) x v).
  { assert (C0 := locally_2d_singleton _ _ _ (cont_diff_0 _ _ _ _ H)).
    destruct (C0 (mkposreal _ (Rabs_pos_lt _ N))) as [d Hd]. exists d. intros a b Ha Hb E.
    assert (Q := Hd a b Ha Hb). simpl in Q. rewrite E, Rminus_0_l, Rabs_Ropp in Q. lra. }
  revert H. induction n as [ | n IH]; intros H.
  - simpl in *. apply (locally_2d_both _ _ _ _ _ Near H). intros a b Nab Cab.
    apply continuity_2d_pt_inv; assumption.
  - assert (I := IH (cont_diff_S _ _ _ _ H)). destruct H as (p & q & D & P & Q).
    exists (fun a b => (-1) * (/ f a b * / f a b) * p a b),
           (fun a b => (-1) * (/ f a b * / f a b) * q a b).
    split. { apply (locally_2d_both _ _ _ _ _ Near D). intros a b Nab.
      apply (D2_apply Rinv f). auto_derive. exact Nab. field. exact Nab. }
    split; apply cont_diff_mult; try assumption; apply cont_diff_scal, cont_diff_mult; exact I.
Qed.

Lemma cont_diff_comp : forall n f g h x v, cont_diff n f (g x v) (h x v) ->
  cont_diff n g x v -> cont_diff n h x v -> cont_diff n (fun a b => f (g a b) (h a b)) x v.
Proof.
  induction n as [ | n IH]; intros f g h x v Hf Hg Hh.
  - simpl in *. assert (Cg := locally_2d_singleton _ _ _ Hg).
    assert (Ch := locally_2d_singleton _ _ _ Hh).
    assert (F := locally_2d_comp _ g h x v Hf Cg Ch). simpl in F.
    apply (locally_2d_both _ _ _ _ _ F (locally_2d_and _ _ _ _ Hg Hh)). intros a b Cf [Ga Ha].
    intros eps. destruct (Cf eps) as [d Hd].
    destruct (Ga d) as [d1 H1]. destruct (Ha d) as [d2 H2].
    assert (D : 0 < Rmin d1 d2) by (apply Rmin_glb_lt; apply cond_pos).
    exists (mkposreal _ D). simpl. intros u z Hu Hz.
    assert (L1 := Rmin_l d1 d2). assert (L2 := Rmin_r d1 d2).
    apply Hd. apply H1; lra. apply H2; lra.
  - assert (Lg := cont_diff_S _ _ _ _ Hg). assert (Lh := cont_diff_S _ _ _ _ Hh).
    destruct Hf as (p & q & D & P & Q). destruct Hg as (p1 & q1 & D1 & P1 & Q1).
    destruct Hh as (p2 & q2 & D2 & P2 & Q2).
    exists (fun a b => p (g a b) (h a b) * p1 a b + q (g a b) (h a b) * p2 a b),
           (fun a b => p (g a b) (h a b) * q1 a b + q (g a b) (h a b) * q2 a b).
    split; [ | split; apply cont_diff_plus; apply cont_diff_mult; auto].
    assert (Cg := D2_continuous _ _ _ _ _ (locally_2d_singleton _ _ _ D1)).
    assert (Ch := D2_continuous _ _ _ _ _ (locally_2d_singleton _ _ _ D2)).
    assert (F := locally_2d_comp _ g h x v D Cg Ch). simpl in F.
    apply (locally_2d_both _ _ _ _ _ F (locally_2d_and _ _ _ _ D1 D2)). intros a b Df [Dg Dh].
    apply differentiable_pt_lim_comp; assumption.
Qed.

Lemma smooth_comp : forall f g h x v, smooth f (g x v) (h x v) -> smooth g x v -> smooth h x v ->
  smooth (fun a b => f (g a b) (h a b)) x v.
Proof.
  intros f g h x v Sf Sg Sh.
  assert (Cg := locally_2d_singleton _ _ _ (smooth_here _ _ _ Sg 0%nat)).
  assert (Ch := locally_2d_singleton _ _ _ (smooth_here _ _ _ Sh 0%nat)).
  apply (locally_2d_both _ _ _ _ _ (locally_2d_comp _ g h x v Sf Cg Ch) (locally_2d_and _ _ _ _ Sg Sh)).
  intros a b F [G H] n. apply cont_diff_comp; auto.
Qed.
