(** * Two flights that close up

    From the right wall at t1 to the left wall at t2, and back at t1 + 2 pi with the speed that the
    first flight began with: repeated with the period 2 pi, for all times, this is a motion; it is
    at the right wall at t1 + 2 pi n only, at the left one at t2 + 2 pi n only. *)

From Coq Require Import Reals Lra Lia ZArith.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Limits Motion Flight.
Open Scope R_scope.

Section Periodic.

Variables f l r : R.
Hypothesis walls : l < r.

Notation vel := (vel f).
Notation pos := (pos f).
Notation laws := (laws 1 1 f l r 1).
Notation motion := (motion 1 1 f l r 1).
Notation laws_on_flight := (laws_on_flight f l r).
Notation laws_at_right_hit := (laws_at_right_hit f l r walls).
Notation laws_at_left_hit := (laws_at_left_hit f l r walls).
Notation pos_increasing := (pos_increasing f).
Notation pos_decreasing := (pos_decreasing f).
Notation pos_start := (pos_start f).

Variables t1 t2 u1 u2 : R.
Hypothesis order : t1 < t2 < t1 + 2 * PI.
Hypothesis second : forall t, t1 <= t <= t2 -> vel (-1) t1 (- u1) t < 0.
Hypothesis third : forall t, t2 <= t <= t1 + 2 * PI -> 0 < vel 1 t2 u2 t.
Hypothesis hit_l : pos (-1) t1 r (- u1) t2 = l.
Hypothesis speed_l : vel (-1) t1 (- u1) t2 = - u2.
Hypothesis hit_r : pos 1 t2 l u2 (t1 + 2 * PI) = r.
Hypothesis speed_r : vel 1 t2 u2 (t1 + 2 * PI) = u1.

Definition turn (t : R) : R := IZR (up ((t - t1) / (2 * PI)) - 1) * (2 * PI).
Definition periodic_x (t : R) : R :=
  if Rlt_dec (t - turn t) t2 then pos (-1) (t1 + turn t) r (- u1) t
  else pos 1 (t2 + turn t) l u2 t.
Definition periodic_v (t : R) : R :=
  if Rlt_dec (t - turn t) t2 then vel (-1) (t1 + turn t) (- u1) t
  else vel 1 (t2 + turn t) u2 t.

Lemma two_pi_pos : 0 < 2 * PI.
Proof. assert (H := PI_RGT_0). lra. Qed.

Lemma turn_bounds : forall t, t1 + turn t <= t < t1 + turn t + 2 * PI.
Proof.
  intros t. assert (P := two_pi_pos). unfold turn. set (y := (t - t1) / (2 * PI)).
  assert (E : t = t1 + y * (2 * PI)). { unfold y. field. lra. }
  rewrite minus_IZR. destruct (archimed y) as [A B]. nra.
Qed.

Lemma turn_is : forall t n, t1 + IZR n * (2 * PI) <= t < t1 + IZR n * (2 * PI) + 2 * PI ->
  turn t = IZR n * (2 * PI).
Proof.
  intros t n H. assert (P := two_pi_pos). unfold turn. set (y := (t - t1) / (2 * PI)).
  assert (E : t = t1 + y * (2 * PI)). { unfold y. field. lra. }
  f_equal. rewrite E in H. f_equal.
  assert (n + 1 = up y)%Z. 2: lia.
  apply tech_up; rewrite plus_IZR; nra.
Qed.

Lemma turn_turns : forall t, exists n, turn t = IZR n * (2 * PI).
Proof. intros t. exists (up ((t - t1) / (2 * PI)) - 1)%Z. reflexivity. Qed.

Lemma sin_turn : forall t n, sin (t + IZR n * (2 * PI)) = sin t.
Proof.
  assert (H : forall t (n : nat), sin (t + INR n * (2 * PI)) = sin t).
  { intros t n. replace (t + INR n * (2 * PI)) with (t + 2 * INR n * PI) by ring. apply sin_period. }
  intros t n. destruct (Z_le_gt_dec 0 n) as [L | G].
  - rewrite <- (Z2Nat.id n L), <- INR_IZR_INZ. apply H.
  - rewrite <- (H _ (Z.to_nat (- n))). f_equal.
    rewrite INR_IZR_INZ, Z2Nat.id, opp_IZR by lia. ring.
Qed.

Lemma cos_turn : forall t n, cos (t + IZR n * (2 * PI)) = cos t.
Proof.
  assert (H : forall t (n : nat), cos (t + INR n * (2 * PI)) = cos t).
  { intros t n. replace (t + INR n * (2 * PI)) with (t + 2 * INR n * PI) by ring. apply cos_period. }
  intros t n. destruct (Z_le_gt_dec 0 n) as [L | G].
  - rewrite <- (Z2Nat.id n L), <- INR_IZR_INZ. apply H.
  - rewrite <- (H _ (Z.to_nat (- n))). f_equal.
    rewrite INR_IZR_INZ, Z2Nat.id, opp_IZR by lia. ring.
Qed.

Lemma pos_turn : forall s t0 x0 v0 t n,
  pos s (t0 + IZR n * (2 * PI)) x0 v0 (t + IZR n * (2 * PI)) = pos s t0 x0 v0 t.
Proof. intros. unfold pos. rewrite !sin_turn, !cos_turn. field. Qed.

Lemma vel_turn : forall s t0 v0 t n,
  vel s (t0 + IZR n * (2 * PI)) v0 (t + IZR n * (2 * PI)) = vel s t0 v0 t.
Proof. intros. unfold vel. rewrite !sin_turn. ring. Qed.

Lemma on_second : forall n t,
  t1 + IZR n * (2 * PI) <= t < t2 + IZR n * (2 * PI) ->
  periodic_x t = pos (-1) (t1 + IZR n * (2 * PI)) r (- u1) t /\
  periodic_v t = vel (-1) (t1 + IZR n * (2 * PI)) (- u1) t.
Proof.
  intros n t H. assert (P := two_pi_pos). unfold periodic_x, periodic_v.
  rewrite (turn_is t n) by lra.
  destruct (Rlt_dec _ _); [auto | lra].
Qed.

Lemma on_third : forall n t,
  t2 + IZR n * (2 * PI) <= t < t1 + IZR n * (2 * PI) + 2 * PI ->
  periodic_x t = pos 1 (t2 + IZR n * (2 * PI)) l u2 t /\
  periodic_v t = vel 1 (t2 + IZR n * (2 * PI)) u2 t.
Proof.
  intros n t H. assert (P := two_pi_pos). unfold periodic_x, periodic_v.
  rewrite (turn_is t n) by lra.
  destruct (Rlt_dec _ _); [lra | auto].
Qed.

Lemma which : forall t, exists n,
  t = t1 + IZR n * (2 * PI) \/
  t1 + IZR n * (2 * PI) < t < t2 + IZR n * (2 * PI) \/
  t = t2 + IZR n * (2 * PI) \/
  t2 + IZR n * (2 * PI) < t < t1 + IZR n * (2 * PI) + 2 * PI.
Proof.
  intros t. destruct (turn_turns t) as [n En]. assert (B := turn_bounds t). rewrite En in B.
  exists n. destruct (Rtotal_order t (t2 + IZR n * (2 * PI))) as [H | [H | H]]; lra.
Qed.

Lemma flight_2 : forall n t, t1 + IZR n * (2 * PI) <= t <= t2 + IZR n * (2 * PI) ->
  vel (-1) (t1 + IZR n * (2 * PI)) (- u1) t < 0.
Proof.
  intros n t H. replace t with (t - IZR n * (2 * PI) + IZR n * (2 * PI)) by ring.
  rewrite vel_turn. apply second. lra.
Qed.

Lemma flight_3 : forall n t,
  t2 + IZR n * (2 * PI) <= t <= t1 + IZR n * (2 * PI) + 2 * PI ->
  0 < vel 1 (t2 + IZR n * (2 * PI)) u2 t.
Proof.
  intros n t H. replace t with (t - IZR n * (2 * PI) + IZR n * (2 * PI)) by ring.
  rewrite vel_turn. apply third. lra.
Qed.

Lemma inside_2 : forall n t, t1 + IZR n * (2 * PI) < t < t2 + IZR n * (2 * PI) ->
  l < pos (-1) (t1 + IZR n * (2 * PI)) r (- u1) t < r.
Proof.
  intros n t H. set (N := IZR n * (2 * PI)) in *.
  assert (I := pos_decreasing (-1) (t1 + N) r (- u1) (t1 + N) (t2 + N) (flight_2 n)).
  assert (A := I (t1 + N) t ltac:(lra) ltac:(lra) ltac:(lra)).
  assert (B := I t (t2 + N) ltac:(lra) ltac:(lra) ltac:(lra)).
  assert (E : pos (-1) (t1 + N) r (- u1) (t2 + N) = l) by (unfold N; rewrite pos_turn; exact hit_l).
  rewrite pos_start in A. lra.
Qed.

Lemma end_3 : forall n,
  pos 1 (t2 + IZR n * (2 * PI)) l u2 (t1 + IZR n * (2 * PI) + 2 * PI) = r /\
  vel 1 (t2 + IZR n * (2 * PI)) u2 (t1 + IZR n * (2 * PI) + 2 * PI) = u1.
Proof.
  intros n.
  replace (t1 + IZR n * (2 * PI) + 2 * PI) with (t1 + 2 * PI + IZR n * (2 * PI)) by ring.
  rewrite pos_turn, vel_turn. auto.
Qed.

Lemma inside_3 : forall n t, t2 + IZR n * (2 * PI) < t < t1 + IZR n * (2 * PI) + 2 * PI ->
  l < pos 1 (t2 + IZR n * (2 * PI)) l u2 t < r.
Proof.
  intros n t H. destruct (end_3 n) as [E _]. set (N := IZR n * (2 * PI)) in *.
  assert (I := pos_increasing 1 (t2 + N) l u2 (t2 + N) (t1 + N + 2 * PI) (flight_3 n)).
  assert (A := I (t2 + N) t ltac:(lra) ltac:(lra) ltac:(lra)).
  assert (B := I t (t1 + N + 2 * PI) ltac:(lra) ltac:(lra) ltac:(lra)).
  rewrite pos_start in A. lra.
Qed.

Lemma before : forall n, IZR n * (2 * PI) = IZR (n - 1) * (2 * PI) + 2 * PI.
Proof. intros n. rewrite minus_IZR. ring. Qed.

Lemma periodic_laws : forall t, laws periodic_x periodic_v t.
Proof.
  intros t. assert (P := two_pi_pos). destruct (which t) as [n [E | [H | [E | H]]]].
  - assert (Bn := before n). destruct (end_3 (n - 1)) as [Ep Ev].
    set (d := Rmin (t2 - t1) (t1 + 2 * PI - t2)).
    assert (D1 := Rmin_l (t2 - t1) (t1 + 2 * PI - t2) : d <= _).
    assert (D2 := Rmin_r (t2 - t1) (t1 + 2 * PI - t2) : d <= _).
    replace (t1 + IZR (n - 1) * (2 * PI) + 2 * PI) with t in Ep, Ev by lra.
    apply (laws_at_right_hit _ _ t d (t2 + IZR (n - 1) * (2 * PI)) l u2 u1); auto.
    + apply Rmin_glb_lt; lra.
    + left. rewrite <- Ev. apply flight_3. lra.
    + intros y Hy. apply on_third. lra.
    + intros y Hy. rewrite E at 1 2. apply on_second. lra.
  - set (N := IZR n * (2 * PI)) in *.
    set (d := Rmin (t - (t1 + N)) (t2 + N - t)).
    assert (D1 := Rmin_l (t - (t1 + N)) (t2 + N - t) : d <= _).
    assert (D2 := Rmin_r (t - (t1 + N)) (t2 + N - t) : d <= _).
    apply (laws_on_flight _ _ t d (-1) (t1 + N) r (- u1)).
    + apply Rmin_glb_lt; lra.
    + intros y Hy. apply on_second. fold N. lra.
    + apply inside_2. exact H.
    + apply sign_eq_m1, flight_2. fold N. lra.
  - set (d := Rmin (t2 - t1) (t1 + 2 * PI - t2)).
    assert (D1 := Rmin_l (t2 - t1) (t1 + 2 * PI - t2) : d <= _).
    assert (D2 := Rmin_r (t2 - t1) (t1 + 2 * PI - t2) : d <= _).
    apply (laws_at_left_hit _ _ t d (t1 + IZR n * (2 * PI)) r (- u1) u2); auto.
    + apply Rmin_glb_lt; lra.
    + assert (A := second t2 ltac:(lra)). lra.
    + intros y Hy. apply on_second. lra.
    + intros y Hy. rewrite E at 1 2. apply on_third. lra.
    + rewrite E, pos_turn. exact hit_l.
    + rewrite E, vel_turn. exact speed_l.
  - set (N := IZR n * (2 * PI)) in *.
    set (d := Rmin (t - (t2 + N)) (t1 + N + 2 * PI - t)).
    assert (D1 := Rmin_l (t - (t2 + N)) (t1 + N + 2 * PI - t) : d <= _).
    assert (D2 := Rmin_r (t - (t2 + N)) (t1 + N + 2 * PI - t) : d <= _).
    apply (laws_on_flight _ _ t d 1 (t2 + N) l u2).
    + apply Rmin_glb_lt; lra.
    + intros y Hy. apply on_third. fold N. lra.
    + apply inside_3. exact H.
    + apply sign_eq_1, flight_3. fold N. lra.
Qed.

Lemma turn_next : forall t, turn (t + 2 * PI) = turn t + 2 * PI.
Proof.
  intros t. destruct (turn_turns t) as [n En]. assert (B := turn_bounds t). rewrite En in B.
  rewrite (turn_is (t + 2 * PI) (n + 1)); rewrite plus_IZR; try rewrite En; nra.
Qed.

Lemma periodic_periodic : forall t,
  periodic_x (t + 2 * PI) = periodic_x t /\ periodic_v (t + 2 * PI) = periodic_v t.
Proof.
  intros t. unfold periodic_x, periodic_v. rewrite turn_next.
  replace (t + 2 * PI - (turn t + 2 * PI)) with (t - turn t) by ring.
  assert (Q : forall s x0 v0 h, pos s (h + (turn t + 2 * PI)) x0 v0 (t + 2 * PI) =
                                pos s (h + turn t) x0 v0 t).
  { intros. rewrite <- (pos_turn s (h + turn t) x0 v0 t 1). f_equal; ring. }
  assert (Q' : forall s v0 h, vel s (h + (turn t + 2 * PI)) v0 (t + 2 * PI) =
                              vel s (h + turn t) v0 t).
  { intros. rewrite <- (vel_turn s (h + turn t) v0 t 1). f_equal; ring. }
  destruct (Rlt_dec _ _); rewrite !Q, !Q'; auto.
Qed.

Lemma periodic_hits : forall t,
  (periodic_x t = r <-> exists n, t = t1 + IZR n * (2 * PI)) /\
  (periodic_x t = l <-> exists n, t = t2 + IZR n * (2 * PI)).
Proof.
  assert (P := two_pi_pos).
  assert (R1 : forall n, periodic_x (t1 + IZR n * (2 * PI)) = r).
  { intros n. rewrite (proj1 (on_second n (t1 + IZR n * (2 * PI)) ltac:(lra))). apply pos_start. }
  assert (R2 : forall n, periodic_x (t2 + IZR n * (2 * PI)) = l).
  { intros n. rewrite (proj1 (on_third n (t2 + IZR n * (2 * PI)) ltac:(lra))). apply pos_start. }
  intros t. split; split.
  - intros E. destruct (which t) as [n [H | [H | [H | H]]]]; exists n; auto; exfalso.
    + rewrite (proj1 (on_second n t ltac:(lra))) in E. assert (A := inside_2 n t H). lra.
    + rewrite H, R2 in E. lra.
    + rewrite (proj1 (on_third n t ltac:(lra))) in E. assert (A := inside_3 n t H). lra.
  - intros [n ->]. apply R1.
  - intros E. destruct (which t) as [n [H | [H | [H | H]]]]; exists n; auto; exfalso.
    + rewrite H, R1 in E. lra.
    + rewrite (proj1 (on_second n t ltac:(lra))) in E. assert (A := inside_2 n t H). lra.
    + rewrite (proj1 (on_third n t ltac:(lra))) in E. assert (A := inside_3 n t H). lra.
  - intros [n ->]. apply R2.
Qed.

(** A lower bound of the speed. *)

Lemma periodic_speed : forall m,
  (forall t, t1 <= t <= t2 -> vel (-1) t1 (- u1) t <= - m) ->
  (forall t, t2 <= t <= t1 + 2 * PI -> m <= vel 1 t2 u2 t) ->
  forall t, m <= Rabs (periodic_v t).
Proof.
  intros m H2 H3 t. assert (P := two_pi_pos).
  destruct (turn_turns t) as [n En]. assert (B := turn_bounds t). rewrite En in B.
  replace t with (t - IZR n * (2 * PI) + IZR n * (2 * PI)) by ring.
  destruct (Rlt_dec t (t2 + IZR n * (2 * PI))) as [H | H].
  - rewrite (proj2 (on_second n (t - IZR n * (2 * PI) + IZR n * (2 * PI)) ltac:(lra))), vel_turn.
    assert (A := H2 (t - IZR n * (2 * PI)) ltac:(lra)).
    assert (A' := Rle_abs (- vel (-1) t1 (- u1) (t - IZR n * (2 * PI)))).
    rewrite Rabs_Ropp in A'. lra.
  - rewrite (proj2 (on_third n (t - IZR n * (2 * PI) + IZR n * (2 * PI)) ltac:(lra))), vel_turn.
    assert (A := H3 (t - IZR n * (2 * PI)) ltac:(lra)).
    assert (A' := Rle_abs (vel 1 t2 u2 (t - IZR n * (2 * PI)))). lra.
Qed.

End Periodic.
