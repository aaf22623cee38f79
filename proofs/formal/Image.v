(** * States whose motion hits the right wall, then the left wall, and never stops in a period

    [passes a b s1 s2]: from (a, b) at time 0 three flights of signs 1, -1, 1, the second from the
    right wall at s1, the third from the left wall at s2, to the time 2 pi.  Then the map of the
    period is explicit at (a, b).  The conditions are strict inequalities on compact intervals of
    time: they hold for all states and hits near one. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Limits Motion Flight Three Plane Hits.
Open Scope R_scope.

Section Image.

Variables f l r : R.
Hypothesis walls : l < r.

Notation vel := (vel f).
Notation pos := (pos f).
Notation image := (image 1 1 f l r 1).
Notation motion := (motion 1 1 f l r 1).

Definition after1 (b s1 : R) : R := vel 1 0 b s1.
Definition after2 (b s1 s2 : R) : R := - vel (-1) s1 (- after1 b s1) s2.
Definition end_x (b s1 s2 : R) : R := pos 1 s2 l (after2 b s1 s2) (2 * PI).
Definition end_v (b s1 s2 : R) : R := vel 1 s2 (after2 b s1 s2) (2 * PI).

Record passes (a b s1 s2 : R) : Prop := {
  p_order : 0 < s1 /\ s1 < s2 /\ s2 < 2 * PI;
  p_start : l < a;
  p_first : forall t, 0 <= t <= s1 -> 0 < vel 1 0 b t;
  p_second : forall t, s1 <= t <= s2 -> vel (-1) s1 (- after1 b s1) t < 0;
  p_third : forall t, s2 <= t <= 2 * PI -> 0 < vel 1 s2 (after2 b s1 s2) t;
  p_right : pos 1 0 a b s1 = r;
  p_left : pos (-1) s1 r (- after1 b s1) s2 = l;
  p_stop : end_x b s1 s2 < r }.

Lemma image_of_motion : forall x v, motion 0 (T 1) x v -> never_stops 0 (T 1) v ->
  image (x 0) (v 0) (x (T 1)) (v (T 1)).
Proof.
  intros x v M N. split. exists x, v. tauto.
  assert (P := PI_RGT_0). assert (E := T_1).
  intros y z M' E0 E1. apply (motion_unique 1 1 f l r 1 walls 0 (T 1) x v y z); auto; lra.
Qed.

Lemma image_unique : forall a b y z y' z', image a b y z -> image a b y' z' -> y = y' /\ z = z'.
Proof.
  intros a b y z y' z' [[x [v [M [_ [E [E' [E1 E2]]]]]]] _] [_ H].
  destruct (H x v M E E'). subst. auto.
Qed.

Lemma passes_image : forall a b s1 s2, passes a b s1 s2 ->
  image a b (end_x b s1 s2) (end_v b s1 s2).
Proof.
  intros a b s1 s2 [Ord Hl X1 X2 X3 Hr X4 X5].
  assert (M := three_motion f l r walls 0 (2 * PI) s1 s2 a b Ord Hl X1 X2 X3 Hr X4 X5).
  assert (N := three_never_stops f l r 0 (2 * PI) s1 s2 a b Ord X1 X2 X3).
  rewrite <- T_1 in M, N at 1. assert (Im := image_of_motion _ _ M N). rewrite T_1 in Im.
  destruct (three_1 f l r 0 s1 s2 a b 0 ltac:(lra)) as [R1 R2].
  destruct (three_3 f l r 0 (2 * PI) s1 s2 a b ltac:(lra) (2 * PI) ltac:(lra)) as [R3 R4].
  rewrite R1, R2, R3, R4, pos_start, vel_start in Im. exact Im.
Qed.

Lemma passes_speeds : forall a b s1 s2, passes a b s1 s2 -> 0 < after1 b s1 /\ 0 < after2 b s1 s2.
Proof.
  intros a b s1 s2 [Ord _ X1 X2 _ _ _ _]. split. apply X1. lra.
  assert (A := X2 s2 ltac:(lra)). unfold after2. lra.
Qed.

(** ** A flight that does not stop has neighbours that do not stop *)

Lemma flight_open : forall s a b c, Rabs s = 1 -> a <= c ->
  (forall t, a <= t <= c -> 0 < s * vel s a b t) -> exists d, 0 < d /\ forall a' b' c',
    Rabs (a' - a) < d -> Rabs (b' - b) < d -> Rabs (c' - c) < d ->
    forall t, a' <= t <= c' -> 0 < s * vel s a' b' t.
Proof.
  intros s a b c Hs Hac Pos.
  destruct (continuity_ab_min (fun t => s * vel s a b t) a c Hac) as [m [Hm Im]].
  { intros t _. apply continuity_pt_scal, continuity_pt_filterlim, vel_continuous. }
  assert (M := Pos m Im). set (h := s * vel s a b m) in *.
  assert (K := Lip_pos f). set (d := h / (4 * (1 + Rabs f))).
  assert (Ed : (1 + Rabs f) * (4 * d) = h) by (unfold d; field; lra).
  assert (Hd : 0 < d) by (apply Rdiv_lt_0_compat; lra).
  exists d. split. exact Hd. intros a' b' c' Ha Hb Hc t Ht.
  apply Rabs_def2 in Ha. apply Rabs_def2 in Hc.
  set (t0 := Rmax a (Rmin c t)).
  assert (I0 : a <= t0 <= c). { split. apply Rmax_l. apply Rmax_lub. lra. apply Rmin_l. }
  assert (D0 : Rabs (t - t0) <= d).
  { apply Rabs_le. unfold t0. destruct (Rle_dec t c) as [L | L].
    - rewrite (Rmin_right c t L). destruct (Rle_dec a t). rewrite Rmax_right; lra.
      rewrite Rmax_left; lra.
    - rewrite Rmin_left by lra. rewrite Rmax_right; lra. }
  assert (Q := vel_Lipschitz f s a b t0 a' b' t Hs). assert (Low := Hm t0 I0). fold h in Low.
  assert (A : Rabs (a' - a) < d) by (apply Rabs_def1; lra).
  set (D := vel s a' b' t - vel s a b t0) in *.
  assert (B : Rabs D < h). { eapply Rle_lt_trans. exact Q. nra. }
  replace (s * vel s a' b' t) with (s * vel s a b t0 + s * D) by (unfold D; ring).
  assert (E : Rabs (s * D) < h) by (rewrite Rabs_mult, Hs; lra).
  apply Rabs_def2 in E. lra.
Qed.

Lemma near : forall h x v (P : R -> Prop), continuity_2d_pt h x v ->
  (exists d, 0 < d /\ forall y, Rabs (y - h x v) < d -> P y) ->
  locally_2d (fun a b => P (h a b)) x v.
Proof.
  intros h x v P Hc [d [Hd HP]]. destruct (Hc (mkposreal d Hd)) as [e He]. exists e.
  intros a b Ha Hb. apply HP. apply He; assumption.
Qed.

Lemma between_open : forall p y q, p < y < q ->
  exists d, 0 < d /\ forall z, Rabs (z - y) < d -> p < z < q.
Proof.
  intros p y q H. assert (L1 := Rmin_l (y - p) (q - y)). assert (L2 := Rmin_r (y - p) (q - y)).
  exists (Rmin (y - p) (q - y)). split. apply Rmin_glb_lt; lra.
  intros z Hz. apply Rabs_def2 in Hz. lra.
Qed.

(** The conditions, for hits that are continuous functions of the state. *)

Theorem passes_open : forall (H G : R -> R -> R) x v, passes x v (H x v) (G x v) ->
  continuity_2d_pt H x v -> continuity_2d_pt G x v ->
  continuity_2d_pt (fun a b => after1 b (H a b)) x v ->
  continuity_2d_pt (fun a b => after2 b (H a b) (G a b)) x v ->
  continuity_2d_pt (fun a b => end_x b (H a b) (G a b)) x v ->
  locally_2d (fun a b => pos 1 0 a b (H a b) = r) x v ->
  locally_2d (fun a b => pos (-1) (H a b) r (- after1 b (H a b)) (G a b) = l) x v ->
  locally_2d (fun a b => passes a b (H a b) (G a b)) x v.
Proof.
  intros H G x v [Ord Hl X1 X2 X3 _ _ X5] C1 C2 C3 C4 C5 Hits1 Hits2.
  destruct (flight_open 1 0 v (H x v) ltac:(apply Rabs_R1) ltac:(lra)) as [d1 [P1 F1]].
  { intros t Ht. rewrite Rmult_1_l. apply X1, Ht. }
  destruct (flight_open (-1) (H x v) (- after1 v (H x v)) (G x v) ltac:(rewrite Rabs_left; lra)
    ltac:(lra)) as [d2 [P2 F2]].
  { intros t Ht. assert (Q := X2 t Ht). lra. }
  destruct (flight_open 1 (G x v) (after2 v (H x v) (G x v)) (2 * PI) ltac:(apply Rabs_R1)
    ltac:(lra)) as [d3 [P3 F3]].
  { intros t Ht. rewrite Rmult_1_l. apply X3, Ht. }
  assert (Close : forall (h : R -> R -> R) d, 0 < d -> continuity_2d_pt h x v ->
    locally_2d (fun a b => Rabs (h a b - h x v) < d) x v).
  { intros h d Hd Hc. apply (near h x v (fun y => Rabs (y - h x v) < d) Hc). exists d. auto. }
  assert (A1 := Close _ d1 P1 C1). assert (A2 := Close _ d2 P2 C1).
  assert (A3 := Close _ d2 P2 C2). assert (A4 := Close _ d3 P3 C2).
  assert (A5 := Close _ d1 P1 (continuity_2d_pt_id2 x v)).
  assert (A6 := Close _ d2 P2 C3). assert (A7 := Close _ d3 P3 C4).
  assert (B1 := near H x v (fun y => 0 < y < G x v) C1 (between_open 0 (H x v) (G x v) ltac:(lra))).
  set (m := (H x v + G x v) / 2).
  assert (B2 := near H x v (fun y => 0 < y < m) C1
    (between_open 0 (H x v) m ltac:(unfold m; lra))).
  assert (B3 := near G x v (fun y => m < y < 2 * PI) C2
    (between_open m (G x v) (2 * PI) ltac:(unfold m; lra))).
  assert (B4 := near (fun a _ => a) x v (fun y => l < y < x + 1) (continuity_2d_pt_id1 x v)
    (between_open l x (x + 1) ltac:(lra))).
  set (e := end_x v (H x v) (G x v)) in *.
  assert (B5 := near _ x v (fun y => e - 1 < y < r) C5 (between_open (e - 1) e r ltac:(lra))).
  assert (All := locally_2d_and _ _ _ _ Hits1 (locally_2d_and _ _ _ _ Hits2
    (locally_2d_and _ _ _ _ A1 (locally_2d_and _ _ _ _ A2 (locally_2d_and _ _ _ _ A3
    (locally_2d_and _ _ _ _ A4 (locally_2d_and _ _ _ _ A5 (locally_2d_and _ _ _ _ A6
    (locally_2d_and _ _ _ _ A7 (locally_2d_and _ _ _ _ B2 (locally_2d_and _ _ _ _ B3
    (locally_2d_and _ _ _ _ B4 B5)))))))))))).
  apply locally_2d_impl with (2 := All). apply locally_2d_forall.
  intros a b (E1 & E2 & I1 & I2 & I3 & I4 & I5 & I6 & I7 & I8 & I9 & I10 & I11).
  assert (Z : forall z d, 0 < d -> Rabs (z - z) < d).
  { intros z d Hd. rewrite Rminus_eq_0, Rabs_R0. exact Hd. }
  split; try assumption.
  - lra.
  - apply I10.
  - intros t Ht. rewrite <- (Rmult_1_l (vel 1 0 b t)).
    apply (F1 0 b (H a b)); auto.
  - intros t Ht. assert (Q : 0 < -1 * vel (-1) (H a b) (- after1 b (H a b)) t).
    { apply (F2 (H a b) (- after1 b (H a b)) (G a b)); auto.
      replace (- after1 b (H a b) - - after1 v (H x v)) with (- (after1 b (H a b) - after1 v (H x v)))
        by ring. rewrite Rabs_Ropp. exact I6. }
    lra.
  - intros t Ht. rewrite <- (Rmult_1_l (vel 1 _ _ t)).
    apply (F3 (G a b) (after2 b (H a b) (G a b)) (2 * PI)); auto.
  - apply I11.
Qed.

End Image.
