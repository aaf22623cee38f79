(** * From two flights that close up to the periodic motion and its state at time 0

    The flights of OneOne.v, if the speed on both is at least m > 0 and 0 < t1 < t2 < 2 pi, are a
    motion of period 2 pi; at time 0 it is on its way to the right wall, in a state that [passes]. *)

From Coq Require Import Reals Lra Lia ZArith.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Limits Motion Flight Periodic Image OneOne Dip.
Open Scope R_scope.

Section Orbit.

Variables f l r : R.
Hypothesis walls : l < r.

Notation vel := (vel f).
Notation pos := (pos f).
Notation T := (2 * PI).

Lemma pos_again : forall s t0 x0 v0 t,
  pos s 0 (pos s t0 x0 v0 T) (vel s t0 v0 T) t = pos s t0 x0 v0 (t + T).
Proof.
  intros. unfold Flight.pos, Flight.vel.
  rewrite cos_plus, sin_2PI, cos_2PI, sin_0, cos_0. field.
Qed.

Lemma vel_again : forall s t0 v0 t, vel s 0 (vel s t0 v0 T) t = vel s t0 v0 (t + T).
Proof.
  intros. unfold Flight.vel. rewrite sin_plus, sin_2PI, cos_2PI, sin_0. ring.
Qed.

(** ** The speeds on the two flights *)

Definition back_speed (t1 u1 t : R) : R := - vel (-1) t1 (- u1) t.
Definition forth_speed (t2 u2 t : R) : R := vel 1 t2 u2 t.

Lemma back_speed_is : forall t1 u1 t,
  back_speed t1 u1 t = h f (u1 + sin t1 + f * (t1 + PI)) (t + PI).
Proof. intros. unfold back_speed, Flight.vel, h. rewrite neg_sin. ring. Qed.

Lemma forth_speed_is : forall t2 u2 t, forth_speed t2 u2 t = h f (u2 - sin t2 + f * t2) t.
Proof. intros. unfold forth_speed, Flight.vel, h. ring. Qed.

(** The points where they are least. *)

Definition back_lowest (t1 t2 : R) : R := Rmax t1 (Rmin (PI - turn f) t2).
Definition forth_lowest (t1 t2 : R) : R := Rmax t2 (Rmin (T - turn f) (t1 + T)).

Section Least.

Variables t1 t2 u1 u2 : R.
Hypothesis f_small : 0 < f < 1.
Hypothesis order : 0 < t1 /\ t1 < t2 /\ PI / 2 < t2 /\ t2 < T /\ t2 < t1 + T /\ t1 < PI.
Hypothesis orbit : closes f l r t1 t2 u1 u2.

Lemma back_least : forall t, t1 <= t <= t2 ->
  Rmin (back_speed t1 u1 (back_lowest t1 t2)) u2 <= back_speed t1 u1 t.
Proof.
  intros t Ht. destruct (turn_is f f_small) as (_ & _ & Bt).
  assert (D := dip f (u1 + sin t1 + f * (t1 + PI)) f_small (t1 + PI) (t2 + PI)
    ltac:(unfold low; lra) (t + PI) ltac:(lra)).
  replace (lowest f (t1 + PI) (t2 + PI)) with (back_lowest t1 t2 + PI) in D.
  - rewrite <- !back_speed_is in D. unfold back_speed at 2 in D.
    rewrite (l_speed _ _ _ _ _ _ _ orbit), Ropp_involutive in D. exact D.
  - unfold lowest, back_lowest, low. rewrite Rplus_max_distr_r, Rplus_min_distr_r.
    do 2 f_equal. ring.
Qed.

Lemma forth_least : forall t, t2 <= t <= t1 + T ->
  Rmin (forth_speed t2 u2 (forth_lowest t1 t2)) u1 <= forth_speed t2 u2 t.
Proof.
  intros t Ht. destruct (turn_is f f_small) as (_ & _ & Bt).
  assert (D := dip f (u2 - sin t2 + f * t2) f_small t2 (t1 + T)
    ltac:(unfold low; lra) t Ht).
  change (lowest f t2 (t1 + T)) with (forth_lowest t1 t2) in D.
  rewrite <- !forth_speed_is in D. unfold forth_speed at 2 in D.
  rewrite (r_speed _ _ _ _ _ _ _ orbit) in D. exact D.
Qed.

End Least.

(** ** The motion *)

Section Motion.

Variables t1 t2 u1 u2 m : R.
Hypothesis order : 0 < t1 /\ t1 < t2 /\ t2 < T.
Hypothesis orbit : closes f l r t1 t2 u1 u2.
Hypothesis moving : 0 < m.
Hypothesis back : forall t, t1 <= t <= t2 -> m <= back_speed t1 u1 t.
Hypothesis forth : forall t, t2 <= t <= t1 + T -> m <= forth_speed t2 u2 t.

Definition start_x : R := pos 1 t2 l u2 T.
Definition start_v : R := vel 1 t2 u2 T.

Lemma speeds : m <= u1 /\ m <= u2.
Proof.
  assert (Pi := PI_RGT_0). split.
  - rewrite <- (r_speed _ _ _ _ _ _ _ orbit). apply forth. lra.
  - assert (Q := back t2 ltac:(lra)). unfold back_speed in Q.
    rewrite (l_speed _ _ _ _ _ _ _ orbit) in Q. lra.
Qed.

Lemma starts : vel 1 0 start_v t1 = u1 /\ pos 1 0 start_x start_v t1 = r /\
  after1 f start_v t1 = u1 /\ after2 f start_v t1 t2 = u2.
Proof.
  assert (V : vel 1 0 start_v t1 = u1).
  { unfold start_v. rewrite vel_again. apply orbit. }
  split. exact V. split. { unfold start_x, start_v. rewrite pos_again. apply orbit. }
  split. exact V. unfold after2, after1. rewrite V, (l_speed _ _ _ _ _ _ _ orbit). ring.
Qed.

Theorem orbit_passes : passes f l r start_x start_v t1 t2.
Proof.
  assert (Pi := PI_RGT_0). destruct starts as (V & P & A1 & A2). destruct speeds as [U1 U2].
  assert (Up : forall t, t2 <= t <= t1 + T -> 0 < vel 1 t2 u2 t).
  { intros t Ht. assert (Q := forth t Ht). unfold forth_speed in Q. lra. }
  assert (I := pos_increasing f 1 t2 l u2 t2 (t1 + T) Up).
  split.
  - exact order.
  - unfold start_x. assert (Q := I t2 T ltac:(lra) ltac:(lra) ltac:(lra)).
    rewrite pos_start in Q. exact Q.
  - intros t Ht. unfold start_v. rewrite vel_again. apply Up. lra.
  - intros t Ht. rewrite A1. assert (Q := back t Ht). unfold back_speed in Q. lra.
  - intros t Ht. rewrite A2. apply Up. lra.
  - exact P.
  - rewrite A1. apply orbit.
  - unfold end_x. rewrite A2. rewrite <- (r_position _ _ _ _ _ _ _ orbit). apply I; lra.
Qed.

Lemma orbit_returns : end_x f l start_v t1 t2 = start_x /\ end_v f start_v t1 t2 = start_v.
Proof.
  destruct starts as (_ & _ & _ & A2). unfold end_x, end_v. rewrite A2. auto.
Qed.

Theorem orbit_motion : exists x v : R -> R,
  (forall t, laws 1 1 f l r 1 x v t) /\
  (forall t, x (t + T) = x t /\ v (t + T) = v t) /\
  (forall t, m <= Rabs (v t)) /\
  (forall t, (x t = r <-> exists n, t = t1 + IZR n * T) /\
             (x t = l <-> exists n, t = t2 + IZR n * T)) /\
  x 0 = start_x /\ v 0 = start_v /\ v t1 = - u1 /\ v t2 = u2 /\
  (forall t, t1 <= t <= t2 -> Rabs (v t) = back_speed t1 u1 t) /\
  (forall t, t2 <= t <= t1 + T -> Rabs (v t) = forth_speed t2 u2 t).
Proof.
  assert (Pi := PI_RGT_0). destruct speeds as [U1 U2]. destruct orbit as [Lp Ls Rp Rs].
  assert (Down : forall t, t1 <= t <= t2 -> vel (-1) t1 (- u1) t < 0).
  { intros t Ht. assert (Q := back t Ht). unfold back_speed in Q. lra. }
  assert (Up : forall t, t2 <= t <= t1 + T -> 0 < vel 1 t2 u2 t).
  { intros t Ht. assert (Q := forth t Ht). unfold forth_speed in Q. lra. }
  assert (Ord : t1 < t2 < t1 + T) by lra.
  set (x := periodic_x f l r t1 t2 u1 u2). set (v := periodic_v f t1 t2 u1 u2).
  assert (On2 := on_second f l r t1 t2 u1 u2 Ord 0). assert (On3 := on_third f l r t1 t2 u1 u2 Ord 0).
  replace (t1 + 0 * T) with t1 in * by ring. replace (t2 + 0 * T) with t2 in * by ring.
  fold x v in On2, On3.
  assert (V1 : v t1 = - u1). { rewrite (proj2 (On2 t1 ltac:(lra))). apply vel_start. }
  assert (V2 : v t2 = u2). { rewrite (proj2 (On3 t2 ltac:(lra))). apply vel_start. }
  assert (Per : forall t, x (t + T) = x t /\ v (t + T) = v t).
  { apply periodic_periodic. exact Ord. }
  exists x, v. split. { apply periodic_laws; assumption. }
  split. exact Per.
  split. { apply (periodic_speed f l r t1 t2 u1 u2 Ord); intros t Ht.
    assert (Q := back t Ht). unfold back_speed in Q. lra. apply forth, Ht. }
  split. { apply periodic_hits; assumption. }
  assert (Start : x 0 = start_x /\ v 0 = start_v).
  { destruct (on_third f l r t1 t2 u1 u2 Ord (-1) 0 ltac:(lra)) as [A B].
    unfold x, v. rewrite A, B. unfold start_x, start_v.
    rewrite <- (pos_turn f 1 t2 l u2 T (-1)), <- (vel_turn f 1 t2 u2 T (-1)).
    split; f_equal; ring. }
  split. apply Start. split. apply Start. split. exact V1. split. exact V2. split.
  - intros t Ht. unfold back_speed. destruct (Req_dec t t2) as [-> | N].
    + rewrite V2, Rabs_pos_eq, Ls; lra.
    + rewrite (proj2 (On2 t ltac:(lra))). apply Rabs_left. apply Down. exact Ht.
  - intros t Ht. unfold forth_speed. destruct (Req_dec t (t1 + T)) as [-> | N].
    + rewrite (proj2 (Per t1)), V1, Rabs_Ropp, Rabs_pos_eq, Rs; lra.
    + rewrite (proj2 (On3 t ltac:(lra))). apply Rabs_pos_eq. left. apply Up. exact Ht.
Qed.

End Motion.

End Orbit.
