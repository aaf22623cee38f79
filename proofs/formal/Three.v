(** * Three flights: to the right wall, to the left wall, and on

    From (x0, v0) at the time a with v > 0 to the right wall at t1, with v < 0 to the left wall at
    t2, and with v > 0 to the time b: if the signs hold, this is a motion that never stops. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Limits Motion Flight.
Open Scope R_scope.

Section Three.

Variables f l r : R.
Hypothesis walls : l < r.

Notation vel := (vel f).
Notation pos := (pos f).
Notation motion := (motion 1 1 f l r 1).
Notation laws_on_flight := (laws_on_flight f l r).
Notation laws_at_right_hit := (laws_at_right_hit f l r walls).
Notation laws_at_left_hit := (laws_at_left_hit f l r walls).
Notation pos_increasing := (pos_increasing f).
Notation pos_decreasing := (pos_decreasing f).

Variables a b t1 t2 x0 v0 : R.
Let u1 := vel 1 a v0 t1.
Let u2 := - vel (-1) t1 (- u1) t2.

Definition three_x (t : R) : R :=
  if Rlt_dec t t1 then pos 1 a x0 v0 t
  else if Rlt_dec t t2 then pos (-1) t1 r (- u1) t else pos 1 t2 l u2 t.
Definition three_v (t : R) : R :=
  if Rlt_dec t t1 then vel 1 a v0 t
  else if Rlt_dec t t2 then vel (-1) t1 (- u1) t else vel 1 t2 u2 t.

Hypothesis order : a < t1 /\ t1 < t2 /\ t2 < b.
Hypothesis start : l < x0.
Hypothesis first : forall t, a <= t <= t1 -> 0 < vel 1 a v0 t.
Hypothesis second : forall t, t1 <= t <= t2 -> vel (-1) t1 (- u1) t < 0.
Hypothesis third : forall t, t2 <= t <= b -> 0 < vel 1 t2 u2 t.
Hypothesis hit_r : pos 1 a x0 v0 t1 = r.
Hypothesis hit_l : pos (-1) t1 r (- u1) t2 = l.
Hypothesis stop : pos 1 t2 l u2 b < r.

Lemma three_1 : forall t, t < t1 -> three_x t = pos 1 a x0 v0 t /\ three_v t = vel 1 a v0 t.
Proof. intros t Ht. unfold three_x, three_v. destruct (Rlt_dec t t1); [auto | lra]. Qed.

Lemma three_2 : forall t, t1 <= t < t2 ->
  three_x t = pos (-1) t1 r (- u1) t /\ three_v t = vel (-1) t1 (- u1) t.
Proof.
  intros t Ht. unfold three_x, three_v.
  destruct (Rlt_dec t t1); [lra | destruct (Rlt_dec t t2); [auto | lra]].
Qed.

Lemma three_3 : forall t, t2 <= t ->
  three_x t = pos 1 t2 l u2 t /\ three_v t = vel 1 t2 u2 t.
Proof.
  intros t Ht. unfold three_x, three_v.
  destruct (Rlt_dec t t1); [lra | destruct (Rlt_dec t t2); [lra | auto]].
Qed.

Lemma three_motion : motion a b three_x three_v.
Proof.
  assert (U1 : 0 < u1) by (apply first; lra).
  assert (U2 : 0 < u2). { assert (H := second t2 ltac:(lra)). unfold u2. lra. }
  assert (Xa : pos 1 a x0 v0 a = x0) by apply pos_start.
  assert (I1 := pos_increasing 1 a x0 v0 a t1 first).
  assert (I2 := pos_decreasing (-1) t1 r (- u1) t1 t2 second).
  assert (I3 := pos_increasing 1 t2 l u2 t2 b third).
  assert (X1 : pos (-1) t1 r (- u1) t1 = r) by apply pos_start.
  assert (X2 : pos 1 t2 l u2 t2 = l) by apply pos_start.
  split.
  - intros t Ht. destruct (Rtotal_order t t1) as [H | [-> | H]].
    + set (d := Rmin (t - a) (t1 - t)).
      assert (D1 := Rmin_l (t - a) (t1 - t) : d <= _).
      assert (D2 := Rmin_r (t - a) (t1 - t) : d <= _).
      apply (laws_on_flight three_x three_v t d 1 a x0 v0).
      * apply Rmin_glb_lt; lra.
      * intros y Hy. apply three_1. lra.
      * assert (A := I1 a t ltac:(lra) ltac:(lra) ltac:(lra)).
        assert (B := I1 t t1 ltac:(lra) ltac:(lra) ltac:(lra)). lra.
      * apply sign_eq_1, first. lra.
    + set (d := Rmin (t1 - a) (t2 - t1)).
      assert (D1 := Rmin_l (t1 - a) (t2 - t1) : d <= _).
      assert (D2 := Rmin_r (t1 - a) (t2 - t1) : d <= _).
      apply (laws_at_right_hit three_x three_v t1 d a x0 v0 u1); auto; try lra.
      * apply Rmin_glb_lt; lra.
      * intros y Hy. apply three_1. lra.
      * intros y Hy. apply three_2. lra.
    + destruct (Rtotal_order t t2) as [H' | [-> | H']].
      * set (d := Rmin (t - t1) (t2 - t)).
        assert (D1 := Rmin_l (t - t1) (t2 - t) : d <= _).
        assert (D2 := Rmin_r (t - t1) (t2 - t) : d <= _).
        apply (laws_on_flight three_x three_v t d (-1) t1 r (- u1)).
        -- apply Rmin_glb_lt; lra.
        -- intros y Hy. apply three_2. lra.
        -- assert (A := I2 t1 t ltac:(lra) ltac:(lra) ltac:(lra)).
           assert (B := I2 t t2 ltac:(lra) ltac:(lra) ltac:(lra)). lra.
        -- apply sign_eq_m1, second. lra.
      * set (d := Rmin (t2 - t1) (b - t2)).
        assert (D1 := Rmin_l (t2 - t1) (b - t2) : d <= _).
        assert (D2 := Rmin_r (t2 - t1) (b - t2) : d <= _).
        apply (laws_at_left_hit three_x three_v t2 d t1 r (- u1) u2); auto; try lra.
        -- apply Rmin_glb_lt; lra.
        -- intros y Hy. apply three_2. lra.
        -- intros y Hy. apply three_3. lra.
        -- unfold u2. ring.
      * apply (laws_on_flight three_x three_v t (t - t2) 1 t2 l u2).
        -- lra.
        -- intros y Hy. apply three_3. lra.
        -- assert (A := I3 t2 t ltac:(lra) ltac:(lra) ltac:(lra)).
           assert (B := I3 t b ltac:(lra) ltac:(lra) ltac:(lra)). lra.
        -- apply sign_eq_1, third. lra.
  - rewrite (proj1 (three_1 a ltac:(lra))).
    assert (A := I1 a t1 ltac:(lra) ltac:(lra) ltac:(lra)). lra.
  - rewrite (proj1 (three_3 b ltac:(lra))).
    assert (A := I3 t2 b ltac:(lra) ltac:(lra) ltac:(lra)). lra.
  - rewrite (proj1 (three_1 a ltac:(lra))).
    apply filterlim_ext_loc with (pos 1 a x0 v0).
    apply at_right_intro with (t1 - a). lra. intros y Hy. symmetry. apply three_1. lra.
    apply at_right_of_continuous, pos_continuous.
  - rewrite (proj2 (three_1 a ltac:(lra))).
    apply filterlim_ext_loc with (vel 1 a v0).
    apply at_right_intro with (t1 - a). lra. intros y Hy. symmetry. apply three_1. lra.
    apply at_right_of_continuous, vel_continuous.
  - rewrite (proj1 (three_3 b ltac:(lra))).
    apply filterlim_ext_loc with (pos 1 t2 l u2).
    apply at_left_intro with (b - t2). lra. intros y Hy. symmetry. apply three_3. lra.
    apply at_left_of_continuous, pos_continuous.
  - rewrite (proj2 (three_3 b ltac:(lra))).
    apply filterlim_ext_loc with (vel 1 t2 u2).
    apply at_left_intro with (b - t2). lra. intros y Hy. symmetry. apply three_3. lra.
    apply at_left_of_continuous, vel_continuous.
Qed.

Lemma three_never_stops : never_stops a b three_v.
Proof.
  intros t Ht. destruct (Rlt_dec t t1) as [H | H].
  rewrite (proj2 (three_1 t H)). assert (A := first t ltac:(lra)). lra.
  destruct (Rlt_dec t t2) as [H' | H'].
  rewrite (proj2 (three_2 t ltac:(lra))). assert (A := second t ltac:(lra)). lra.
  rewrite (proj2 (three_3 t ltac:(lra))). assert (A := third t ltac:(lra)). lra.
Qed.

End Three.
