(** * Explicit flights, and the laws where they are joined

    Units F = w = 1 and elastic walls from here on (Scaling.v has the others).  A flight of sign s
    that passes x0 with the velocity v0 at the time t0 is

      v(t) = v0 + (sin t - sin t0) - s f (t - t0),    x' = v,    x(t0) = x0.

    The laws hold on a flight as long as v has the sign s and x is between the walls, and at a hit,
    where a flight with u is followed by one with - u. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Limits Motion.
Open Scope R_scope.

Section Flight.

Variables f l r : R.
Hypothesis walls : l < r.

(** The flight of sign [s] that passes [x0] with the velocity [v0] at the time [t0]. *)

Definition vel (s t0 v0 t : R) : R := v0 + (sin t - sin t0) - s * f * (t - t0).
Definition pos (s t0 x0 v0 t : R) : R :=
  x0 + v0 * (t - t0) - (cos t - cos t0) - sin t0 * (t - t0) - s * f * (t - t0) ^ 2 / 2.

Lemma pos_derive : forall s t0 x0 v0 t, is_derive (pos s t0 x0 v0) t (vel s t0 v0 t).
Proof. intros. unfold pos, vel. auto_derive. exact I. field. Qed.

Lemma vel_derive : forall s t0 v0 t, is_derive (vel s t0 v0) t (cos t - s * f).
Proof. intros. unfold vel. auto_derive. exact I. ring. Qed.

Lemma pos_continuous : forall s t0 x0 v0 t, continuous (pos s t0 x0 v0) t.
Proof.
  intros. apply (ex_derive_continuous (pos s t0 x0 v0)). eexists. apply pos_derive.
Qed.

Lemma vel_continuous : forall s t0 v0 t, continuous (vel s t0 v0) t.
Proof.
  intros. apply (ex_derive_continuous (vel s t0 v0)). eexists. apply vel_derive.
Qed.

Lemma pos_start : forall s t0 x0 v0, pos s t0 x0 v0 t0 = x0.
Proof. intros. unfold pos. field. Qed.

Lemma vel_start : forall s t0 v0, vel s t0 v0 t0 = v0.
Proof. intros. unfold vel. ring. Qed.

Lemma pos_increasing : forall s t0 x0 v0 a b,
  (forall t, a <= t <= b -> 0 < vel s t0 v0 t) ->
  forall t u, a <= t -> t < u -> u <= b -> pos s t0 x0 v0 t < pos s t0 x0 v0 u.
Proof.
  intros s t0 x0 v0 a b H t u Ha Htu Hb.
  destruct (MVT_gen (pos s t0 x0 v0) t u (vel s t0 v0)) as [c [Hc E]].
  - intros. apply pos_derive.
  - intros. apply continuity_pt_filterlim, pos_continuous.
  - rewrite Rmin_left, Rmax_right in Hc by lra. assert (0 < vel s t0 v0 c) by (apply H; lra). nra.
Qed.

Lemma pos_decreasing : forall s t0 x0 v0 a b,
  (forall t, a <= t <= b -> vel s t0 v0 t < 0) ->
  forall t u, a <= t -> t < u -> u <= b -> pos s t0 x0 v0 u < pos s t0 x0 v0 t.
Proof.
  intros s t0 x0 v0 a b H t u Ha Htu Hb.
  destruct (MVT_gen (pos s t0 x0 v0) t u (vel s t0 v0)) as [c [Hc E]].
  - intros. apply pos_derive.
  - intros. apply continuity_pt_filterlim, pos_continuous.
  - rewrite Rmin_left, Rmax_right in Hc by lra. assert (vel s t0 v0 c < 0) by (apply H; lra). nra.
Qed.

(** ** The laws hold where a function is pieced together of flights *)

Notation laws := (laws 1 1 f l r 1).
Notation motion := (motion 1 1 f l r 1).

Lemma laws_on_flight : forall x v t d s t0 x0 v0, 0 < d ->
  (forall y, t - d < y < t + d -> x y = pos s t0 x0 v0 y /\ v y = vel s t0 v0 y) ->
  l < pos s t0 x0 v0 t < r -> sign (vel s t0 v0 t) = s -> laws x v t.
Proof.
  intros x v t d s t0 x0 v0 Hd H Hin Hs.
  destruct (H t ltac:(lra)) as [Ex Ev]. rewrite <- Ex in Hin.
  split. lra. split; [ | split; intros; lra]. intros _. split; [ | split].
  - rewrite Ev. apply is_derive_ext_loc with (pos s t0 x0 v0). 2: apply pos_derive.
    apply locally_intro with d. exact Hd. intros y Hy. symmetry. apply H, Hy.
  - apply continuous_ext_loc with (vel s t0 v0). 2: apply vel_continuous.
    apply locally_intro with d. exact Hd. intros y Hy. symmetry. apply H, Hy.
  - intros _. rewrite Ev, Hs.
    replace (1 * cos (1 * t) - f * s) with (cos t - s * f) by (rewrite !Rmult_1_l; ring).
    apply is_derive_ext_loc with (vel s t0 v0). 2: apply vel_derive.
    apply locally_intro with d. exact Hd. intros y Hy. symmetry. apply H, Hy.
Qed.

Lemma limits_at_hit : forall x v t d s t0 x0 v0 s' x1 v1, 0 < d ->
  (forall y, t - d < y < t -> x y = pos s t0 x0 v0 y /\ v y = vel s t0 v0 y) ->
  (forall y, t <= y < t + d -> x y = pos s' t x1 v1 y /\ v y = vel s' t v1 y) ->
  pos s t0 x0 v0 t = x1 ->
  x t = x1 /\ v t = v1 /\ continuous x t /\
  filterlim v (at_left t) (locally (vel s t0 v0 t)) /\ filterlim v (at_right t) (locally (v t)).
Proof.
  intros x v t d s t0 x0 v0 s' x1 v1 Hd Hb Ha E.
  destruct (Ha t ltac:(lra)) as [Ex Ev]. rewrite pos_start in Ex. rewrite vel_start in Ev.
  split. exact Ex. split. exact Ev. split; [ | split].
  - apply continuous_split; rewrite Ex.
    + rewrite <- E. apply filterlim_ext_loc with (pos s t0 x0 v0).
      apply at_left_intro with d. exact Hd. intros y Hy. symmetry. apply Hb. lra.
      apply at_left_of_continuous, pos_continuous.
    + apply filterlim_ext_loc with (pos s' t x1 v1).
      apply at_right_intro with d. exact Hd. intros y Hy. symmetry. apply Ha. lra.
      assert (H := at_right_of_continuous _ _ (pos_continuous s' t x1 v1 t)).
      rewrite pos_start in H. exact H.
  - apply filterlim_ext_loc with (vel s t0 v0).
    apply at_left_intro with d. exact Hd. intros y Hy. symmetry. apply Hb. lra.
    apply at_left_of_continuous, vel_continuous.
  - rewrite Ev. apply filterlim_ext_loc with (vel s' t v1).
    apply at_right_intro with d. exact Hd. intros y Hy. symmetry. apply Ha. lra.
    assert (H := at_right_of_continuous _ _ (vel_continuous s' t v1 t)).
    rewrite vel_start in H. exact H.
Qed.

Lemma laws_at_right_hit : forall x v t d t0 x0 v0 u, 0 < d -> 0 <= u ->
  (forall y, t - d < y < t -> x y = pos 1 t0 x0 v0 y /\ v y = vel 1 t0 v0 y) ->
  (forall y, t <= y < t + d -> x y = pos (-1) t r (- u) y /\ v y = vel (-1) t (- u) y) ->
  pos 1 t0 x0 v0 t = r -> vel 1 t0 v0 t = u -> laws x v t.
Proof.
  intros x v t d t0 x0 v0 u Hd Hu Hb Ha E E'.
  destruct (limits_at_hit x v t d 1 t0 x0 v0 (-1) r (- u) Hd Hb Ha E) as [Ex [Ev [Cx [Lv Rv]]]].
  split. lra. split. intros; lra. split. 2: intros; lra.
  intros _. split. exact Cx. exists u. rewrite <- E' at 2.
  split. exact Hu. split. exact Lv. split. rewrite Ev. ring. exact Rv.
Qed.

Lemma laws_at_left_hit : forall x v t d t0 x0 v0 u, 0 < d -> 0 <= u ->
  (forall y, t - d < y < t -> x y = pos (-1) t0 x0 v0 y /\ v y = vel (-1) t0 v0 y) ->
  (forall y, t <= y < t + d -> x y = pos 1 t l u y /\ v y = vel 1 t u y) ->
  pos (-1) t0 x0 v0 t = l -> vel (-1) t0 v0 t = - u -> laws x v t.
Proof.
  intros x v t d t0 x0 v0 u Hd Hu Hb Ha E E'.
  destruct (limits_at_hit x v t d (-1) t0 x0 v0 1 l u Hd Hb Ha E) as [Ex [Ev [Cx [Lv Rv]]]].
  split. lra. split. intros; lra. split. intros; lra.
  intros _. split. exact Cx. exists (- u). rewrite <- E' at 2.
  split. lra. split. exact Lv. split. rewrite Ev. ring. exact Rv.
Qed.

End Flight.

Lemma T_1 : T 1 = 2 * PI.
Proof. unfold T. field. Qed.
