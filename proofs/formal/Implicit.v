(** * A function that is given implicitly is differentiable

    Let g(t, a, b) = 0 at one point, and dg/dt > 0 there.  Around it dg/dt is positive, so that g has
    one root t = T(a, b), between two values of t where g has different signs; T is continuous, and
    by the mean value theorem in t

      dT = - dg / (dg/dt)    wherever dg/dt > 0. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Plane.
Open Scope R_scope.

Definition continuous_3 (h : R -> R -> R -> R) (t a b : R) : Prop :=
  forall eps, 0 < eps -> exists d, 0 < d /\ forall t' a' b',
    Rabs (t' - t) < d -> Rabs (a' - a) < d -> Rabs (b' - b) < d ->
    Rabs (h t' a' b' - h t a b) < eps.

Section Root.

Variables g g' p q : R -> R -> R -> R.
Hypothesis slope : forall t a b, is_derive (fun s => g s a b) t (g' t a b).
Hypothesis slope_continuous : forall t a b, continuous_3 g' t a b.
Hypothesis differentiable : forall t a b, D2 (g t) a b (p t a b) (q t a b).

(** ** The root exists and is continuous *)

Lemma increasing : forall a b s s', s < s' ->
  (forall c, s <= c <= s' -> 0 < g' c a b) -> g s a b < g s' a b.
Proof.
  intros a b s s' Hs Pos.
  destruct (MVT_between (fun s => g s a b) (fun s => g' s a b) s s') as [c [Hc E]].
  intros; apply slope. rewrite Rmin_left, Rmax_right in Hc by lra. simpl in E.
  assert (A := Pos c Hc). nra.
Qed.

Lemma sign_near : forall t a b, g t a b <> 0 ->
  exists d, 0 < d /\ forall a' b', Rabs (a' - a) < d -> Rabs (b' - b) < d -> 0 < g t a b * g t a' b'.
Proof.
  intros t a b N. assert (P := Rabs_pos_lt _ N).
  destruct (D2_continuous _ _ _ _ _ (differentiable t a b) (mkposreal _ P)) as [d H].
  exists d. split. apply cond_pos. intros a' b' Ha Hb. assert (Q := H a' b' Ha Hb). simpl in Q.
  apply Rabs_def2 in Q. destruct (Rdichotomy _ _ N) as [L | G].
  rewrite Rabs_left in Q by lra. nra. rewrite Rabs_right in Q by lra. nra.
Qed.

Variables t a b : R.
Hypothesis rising : 0 < g' t a b.
Hypothesis root : g t a b = 0.

Lemma implicit_function : exists T : R -> R -> R, T a b = t /\
  locally_2d (fun a b => g (T a b) a b = 0 /\ 0 < g' (T a b) a b /\ continuity_2d_pt T a b) a b.
Proof.
  destruct (slope_continuous t a b _ rising) as [d0 [Hd0 S0]].
  set (h := d0 / 2).
  assert (Slope : forall s a' b', t - h <= s <= t + h -> Rabs (a' - a) < h -> Rabs (b' - b) < h ->
    0 < g' s a' b').
  { intros s a' b' Hs Ha Hb. unfold h in *.
    assert (Q : Rabs (g' s a' b' - g' t a b) < g' t a b).
    { apply S0; try lra. apply Rabs_def1; lra. }
    apply Rabs_def2 in Q. lra. }
  assert (Hh : 0 < h) by (unfold h; lra).
  assert (Zero : forall z, Rabs (z - z) < h). { intros z. rewrite Rminus_eq_0, Rabs_R0. exact Hh. }
  assert (Rise : forall s s' a' b', t - h <= s -> s < s' -> s' <= t + h ->
    Rabs (a' - a) < h -> Rabs (b' - b) < h -> g s a' b' < g s' a' b').
  { intros s s' a' b' H1 H2 H3 Ha Hb. apply increasing. exact H2.
    intros c Hc. apply Slope; auto. lra. }
  assert (El : g (t - h) a b < 0) by (rewrite <- root; apply Rise; auto; lra).
  assert (Er : 0 < g (t + h) a b) by (rewrite <- root; apply Rise; auto; lra).
  destruct (sign_near (t - h) a b ltac:(lra)) as [d1 [Hd1 N1]].
  destruct (sign_near (t + h) a b ltac:(lra)) as [d2 [Hd2 N2]].
  set (d := Rmin h (Rmin d1 d2)).
  assert (Hd : 0 < d) by (repeat apply Rmin_glb_lt; lra).
  assert (L1 : d <= h) by apply Rmin_l.
  assert (L2 : d <= d1). { eapply Rle_trans. apply Rmin_r. apply Rmin_l. }
  assert (L3 : d <= d2). { eapply Rle_trans. apply Rmin_r. apply Rmin_r. }
  assert (Choice : forall a' b', { s : R | Rabs (a' - a) < d -> Rabs (b' - b) < d ->
    t - h < s < t + h /\ g s a' b' = 0 }).
  { intros a' b'.
    destruct (Rlt_dec (Rabs (a' - a)) d) as [Ha | Ha]; [ | exists 0; intros; lra].
    destruct (Rlt_dec (Rabs (b' - b)) d) as [Hb | Hb]; [ | exists 0; intros; lra].
    assert (A : g (t - h) a' b' < 0) by (specialize (N1 a' b' ltac:(lra) ltac:(lra)); nra).
    assert (B : 0 < g (t + h) a' b') by (specialize (N2 a' b' ltac:(lra) ltac:(lra)); nra).
    destruct (IVT_cor (fun s => g s a' b') (t - h) (t + h)) as [s [Hs E]].
    - intros s. apply continuity_pt_filterlim, (ex_derive_continuous (fun s => g s a' b')).
      eexists. apply slope.
    - lra.
    - simpl. nra.
    - exists s. intros _ _. simpl in E. split. 2: exact E.
      split; apply Rnot_le_lt; intros L.
      + replace s with (t - h) in E by lra. lra.
      + replace s with (t + h) in E by lra. lra. }
  set (T := fun a' b' => proj1_sig (Choice a' b')).
  assert (TP : forall a' b', Rabs (a' - a) < d -> Rabs (b' - b) < d ->
    t - h < T a' b' < t + h /\ g (T a' b') a' b' = 0).
  { intros a' b'. exact (proj2_sig (Choice a' b')). }
  exists T. split.
  { destruct (TP a b) as [I E]; try (rewrite Rminus_eq_0, Rabs_R0; exact Hd).
    destruct (Rtotal_order (T a b) t) as [L | [E' | G]]. 2: exact E'.
    - assert (A := Rise (T a b) t a b ltac:(lra) L ltac:(lra) (Zero a) (Zero b)). lra.
    - assert (A := Rise t (T a b) a b ltac:(lra) G ltac:(lra) (Zero a) (Zero b)). lra. }
  exists (mkposreal d Hd). simpl. intros a' b' Ha Hb. destruct (TP a' b' Ha Hb) as [I E].
  split. exact E. split. apply Slope; lra.
  intros eps. assert (He := cond_pos eps). set (s := T a' b') in *.
  set (n := Rmin (eps / 2) (Rmin (s - (t - h)) (t + h - s))).
  assert (Hn : 0 < n) by (repeat apply Rmin_glb_lt; lra).
  assert (M1 : n <= eps / 2) by apply Rmin_l.
  assert (M2 : n <= s - (t - h)). { eapply Rle_trans. apply Rmin_r. apply Rmin_l. }
  assert (M3 : n <= t + h - s). { eapply Rle_trans. apply Rmin_r. apply Rmin_r. }
  assert (Sl : g (s - n) a' b' < 0) by (rewrite <- E; apply Rise; lra).
  assert (Sr : 0 < g (s + n) a' b') by (rewrite <- E; apply Rise; lra).
  destruct (sign_near (s - n) a' b' ltac:(lra)) as [e1 [He1 K1]].
  destruct (sign_near (s + n) a' b' ltac:(lra)) as [e2 [He2 K2]].
  destruct (ball_in_ball (fun u z => Rabs (u - a) < d /\ Rabs (z - b) < d) a b d a' b')
    as [e3 K3]; auto.
  assert (H3 : 0 < Rmin e3 (Rmin e1 e2)) by (repeat apply Rmin_glb_lt; try apply cond_pos; lra).
  exists (mkposreal _ H3). simpl. intros u z Hu Hz.
  assert (P1 := Rmin_l e3 (Rmin e1 e2)). assert (P2 := Rmin_r e3 (Rmin e1 e2)).
  assert (P3 := Rmin_l e1 e2). assert (P4 := Rmin_r e1 e2).
  destruct (K3 u z ltac:(lra) ltac:(lra)) as [Du Dz]. destruct (TP u z Du Dz) as [J F].
  assert (A := K1 u z ltac:(lra) ltac:(lra)). assert (B := K2 u z ltac:(lra) ltac:(lra)).
  apply Rabs_def1.
  - apply Rnot_le_lt. intros L.
    assert (Q := Rise (s + n) (T u z) u z ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
    nra.
  - apply Rnot_le_lt. intros L.
    assert (Q := Rise (T u z) (s - n) u z ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)).
    nra.
Qed.

(** ** Its derivative *)

Lemma implicit_derivative : forall T : R -> R -> R, T a b = t ->
  locally_2d (fun a b => g (T a b) a b = 0) a b -> continuity_2d_pt T a b ->
  D2 T a b (- p t a b / g' t a b) (- q t a b / g' t a b).
Proof.
  intros T T0 [d3 Roots] Cont. set (m := g' t a b) in *.
  set (P := p t a b). set (Q := q t a b).
  intros eps. assert (He := cond_pos eps).
  set (K := Rabs P + Rabs Q + 1).
  assert (HK : 0 < K). { unfold K. assert (A := Rabs_pos P). assert (B := Rabs_pos Q). lra. }
  set (e1 := Rmin 1 (m * eps / 2)).
  assert (He1 : 0 < e1). { apply Rmin_glb_lt. lra. assert (0 < m * eps) by nra. lra. }
  assert (E1 : e1 <= 1) by apply Rmin_l. assert (E2 : e1 <= m * eps / 2) by apply Rmin_r.
  set (e2 := Rmin (m / 2) (m * m * eps / (4 * K))).
  assert (He2 : 0 < e2).
  { apply Rmin_glb_lt. lra. apply Rdiv_lt_0_compat. 2: lra.
    apply Rmult_lt_0_compat. 2: lra. nra. }
  assert (E3 : e2 <= m / 2) by apply Rmin_l.
  assert (E4 : e2 <= m * m * eps / (4 * K)) by apply Rmin_r.
  destruct (slope_continuous t a b e2 He2) as [d2 [Hd2 S2]].
  destruct (differentiable t a b (mkposreal e1 He1)) as [d1 H1]. simpl in H1. fold P Q in H1.
  destruct (Cont (mkposreal d2 Hd2)) as [d4 H4]. simpl in H4.
  set (d := Rmin (Rmin d1 d2) (Rmin d3 d4)).
  assert (Hd : 0 < d) by (repeat apply Rmin_glb_lt; try apply cond_pos; lra).
  assert (L1 : d <= d1). { eapply Rle_trans. apply Rmin_l. apply Rmin_l. }
  assert (L2 : d <= d2). { eapply Rle_trans. apply Rmin_l. apply Rmin_r. }
  assert (L3 : d <= d3). { eapply Rle_trans. apply Rmin_r. apply Rmin_l. }
  assert (L4 : d <= d4). { eapply Rle_trans. apply Rmin_r. apply Rmin_r. }
  exists (mkposreal d Hd). simpl. intros a' b' Ha Hb. rewrite T0.
  assert (E : g (T a' b') a' b' = 0) by (apply Roots; lra).
  assert (Move := H4 a' b' ltac:(lra) ltac:(lra)). rewrite T0 in Move.
  assert (G := H1 a' b' ltac:(lra) ltac:(lra)). rewrite root, Rminus_0_r in G.
  set (M := Rmax (Rabs (a' - a)) (Rabs (b' - b))) in *.
  assert (M1 : Rabs (a' - a) <= M) by apply Rmax_l.
  assert (M2 : Rabs (b' - b) <= M) by apply Rmax_r.
  assert (M0 : 0 <= M). { assert (A := Rabs_pos (a' - a)). lra. }
  set (lin := P * (a' - a) + Q * (b' - b)) in *.
  assert (Lin : Rabs lin <= (Rabs P + Rabs Q) * M).
  { unfold lin. eapply Rle_trans. apply Rabs_triang. rewrite !Rabs_mult.
    assert (A := Rabs_pos P). assert (B := Rabs_pos Q). nra. }
  assert (G0 : Rabs (g t a' b') <= K * M).
  { replace (g t a' b') with ((g t a' b' - lin) + lin) by ring.
    eapply Rle_trans. apply Rabs_triang. unfold K. nra. }
  set (dt := T a' b' - t) in *.
  destruct (MVT_between (fun s => g s a' b') (fun s => g' s a' b') t (T a' b')) as [c [Hc Ec]].
  intros; apply slope. simpl in Ec. rewrite E in Ec. fold dt in Ec.
  assert (Cn : Rabs (c - t) <= Rabs dt).
  { unfold dt. destruct (Rle_dec t (T a' b')) as [L | L].
    rewrite Rmin_left, Rmax_right in Hc by lra. rewrite !Rabs_pos_eq; lra.
    rewrite Rmin_right, Rmax_left in Hc by lra. rewrite !Rabs_left1; lra. }
  assert (Sc := S2 c a' b' ltac:(lra) ltac:(lra) ltac:(lra)). fold m in Sc.
  assert (Low : m / 2 <= Rabs (g' c a' b')).
  { assert (A := Rle_abs (g' c a' b')). apply Rabs_def2 in Sc. lra. }
  assert (Far : Rabs dt <= 2 * K / m * M).
  { apply Rmult_le_reg_l with (m / 2). lra.
    replace (m / 2 * (2 * K / m * M)) with (K * M) by (field; lra).
    apply Rle_trans with (2 := G0).
    replace (g t a' b') with (- (g' c a' b' * dt)) by lra. rewrite Rabs_Ropp, Rabs_mult.
    apply Rmult_le_compat_r. apply Rabs_pos. exact Low. }
  replace (dt - (- P / m * (a' - a) + - Q / m * (b' - b)))
    with ((- (g t a' b' - lin) - (g' c a' b' - m) * dt) / m).
  2: { unfold lin. replace (g t a' b') with (- (g' c a' b' * dt)) by lra. field. lra. }
  unfold Rdiv at 1. rewrite Rabs_mult, (Rabs_pos_eq (/ m)).
  2: { left. apply Rinv_0_lt_compat. exact rising. }
  apply Rmult_le_reg_r with m. exact rising. rewrite Rmult_assoc, Rinv_l by lra.
  rewrite Rmult_1_r. eapply Rle_trans. apply Rabs_triang. rewrite !Rabs_Ropp, Rabs_mult.
  assert (Last : Rabs (g' c a' b' - m) * Rabs dt <= m * eps / 2 * M).
  { apply Rle_trans with (m * m * eps / (4 * K) * (2 * K / m * M)).
    - apply Rmult_le_compat; try apply Rabs_pos; lra.
    - right. field. lra. }
  nra.
Qed.

End Root.
