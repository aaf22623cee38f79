(** * The map of the period up to O(4)

    The formulas of Stages.v, in real numbers, are the Taylor polynomials of the hit times, of the
    speeds, and of the map: each step of Newton's method gains an order. *)

From Coq Require Import Reals Lra Lia ZArith.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Flight Plane Smooth Order Jet Trig Newton Hits Image Strobe Stages.
Open Scope R_scope.

Section Expansion.

Variables f l r : R.
Variables x v t1 t2 : R.
Hypothesis orbit : passes f l r x v t1 t2.

Notation vel := (vel f).
Notation pos := (pos f).
Notation T := (2 * PI).

Definition around_orbit : around R :=
  Around f l r T x v t1 (sin t1) (cos t1) (/ after1 f v t1)
                     t2 (sin t2) (cos t2) (/ after2 f v t1 t2).

Notation e := around_orbit.
Let u1 := after1 f v t1.
Let u2 := after2 f v t1 t2.

Variables H G : R -> R -> R.
Hypothesis HG : hits f l r x v t1 t2 H G.

Let A (a b : R) := H (x + a) (v + b).
Let U (a b : R) := after1 f (v + b) (A a b).
Let B (a b : R) := G (x + a) (v + b).
Let W (a b : R) := after2 f (v + b) (A a b) (B a b).

Lemma forward : 0 < u1 /\ 0 < u2.
Proof. exact (passes_speeds _ _ _ _ _ _ _ orbit). Qed.

Lemma at_0 : A 0 0 = t1 /\ U 0 0 = u1 /\ B 0 0 = t2.
Proof.
  unfold U, A, B. rewrite !Rplus_0_r, (h_first _ _ _ _ _ _ _ _ _ HG), (h_second _ _ _ _ _ _ _ _ _ HG).
  auto.
Qed.

Lemma order_1_of_smooth : forall h, smooth h x v ->
  order 1 (fun a b => h (x + a) (v + b) - h x v).
Proof.
  intros h S. destruct (smooth_here _ _ _ S 1) as (p & q & D & _).
  exact (order_1_of_D2 _ _ _ _ _ (locally_2d_singleton _ _ _ D)).
Qed.

Lemma A_near : order 1 (fun a b => A a b - t1).
Proof.
  rewrite <- (h_first _ _ _ _ _ _ _ _ _ HG). apply order_1_of_smooth, HG.
Qed.

Lemma B_near : order 1 (fun a b => B a b - t2).
Proof.
  rewrite <- (h_second _ _ _ _ _ _ _ _ _ HG). apply order_1_of_smooth, HG.
Qed.

Lemma U_near : order 1 (fun a b => U a b - u1).
Proof.
  unfold u1. rewrite <- (h_first _ _ _ _ _ _ _ _ _ HG).
  apply (order_1_of_smooth (fun a b => after1 f b (H a b))), HG.
Qed.

Lemma shift_near : order 1 (fun a _ => x + a - x) /\ order 1 (fun _ b => v + b - v).
Proof.
  split. apply order_ext with (2 := order_a). intros; ring.
  apply order_ext with (2 := order_b). intros; ring.
Qed.

Lemma shifted : forall P : R -> R -> Prop, locally_2d P x v ->
  exists d, 0 < d /\ forall a b, size a b < d -> P (x + a) (v + b).
Proof.
  intros P [d Hd]. exists d. split. apply cond_pos. intros a b Hs.
  assert (Sa : Rabs a <= size a b) by apply Rmax_l.
  assert (Sb : Rabs b <= size a b) by apply Rmax_r.
  apply Hd. replace (x + a - x) with a by ring. lra. replace (v + b - v) with b by ring. lra.
Qed.

Lemma root1 : exists d, 0 < d /\ forall a b, size a b < d ->
  pos 1 0 (x + a) (v + b) (A a b) - r = 0.
Proof.
  destruct (shifted _ (h_passes _ _ _ _ _ _ _ _ _ HG)) as [d [Hd P]]. exists d. split. exact Hd.
  intros a b Hs. assert (Q := p_right _ _ _ _ _ _ _ (P a b Hs)). unfold A. lra.
Qed.

Lemma root2 : exists d, 0 < d /\ forall a b, size a b < d ->
  past f l r (B a b) (A a b) (U a b) = 0.
Proof.
  destruct (shifted _ (h_passes _ _ _ _ _ _ _ _ _ HG)) as [d [Hd P]]. exists d. split. exact Hd.
  intros a b Hs. assert (Q := p_left _ _ _ _ _ _ _ (P a b Hs)). unfold past, U, A, B. lra.
Qed.

Ltac close_jets formula := unfold formula; cbv zeta; repeat lazymatch goal with
  | |- approx _ _ (jconst _ _) => apply approx_const
  | |- approx _ _ (ja _ _) => apply approx_a
  | |- approx _ _ (jb _ _) => apply approx_b
  | |- approx _ _ (jminus _ _ _) => apply approx_minus
  | |- approx _ _ (jplus _ _ _) => apply approx_plus
  | |- approx _ _ (jscal _ _ _) => apply approx_scal
  | |- approx _ _ (jmult _ _ _) => apply (approx_mult 4); [ lia | | ]
  end.

(** Sine and cosine of the hit times; [c00] of a polynomial from [jset] is known. *)

Lemma approx_sin_at : forall P j c, approx 4 P j -> c00 j = c ->
  approx 4 (fun a b => sin (P a b)) (jsin real (sin c) (cos c) j) /\
  approx 4 (fun a b => cos (P a b)) (jcos real (sin c) (cos c) j).
Proof. intros P j c HP <-. split. exact (approx_sin P j HP). exact (approx_cos P j HP). Qed.

Lemma approx_g1 : forall P j, approx 4 P j -> c00 j = t1 ->
  approx 4 (fun a b => pos 1 0 (x + a) (v + b) (P a b) - r) (jg1 R real e j).
Proof.
  intros P j HP E. destruct (approx_sin_at P j t1 HP E) as [_ Cos].
  apply approx_ext with (fun a b => (x + a) + ((v + b) * P a b + ((1 + - r) - cos (P a b) +
    (-1 / 2 * f) * (P a b * P a b)))).
  { intros. unfold Flight.pos. rewrite sin_0, cos_0. field. }
  close_jets jg1; assumption.
Qed.

Lemma approx_g2 : forall jA jU P j, approx 4 A jA -> c00 jA = t1 -> approx 4 U jU ->
  approx 4 P j -> c00 j = t2 ->
  approx 4 (fun a b => past f l r (P a b) (A a b) (U a b)) (jg2 R real e jA jU j).
Proof.
  intros jA jU P j HA EA HU HP E.
  destruct (approx_sin_at A jA t1 HA EA) as [Sin1 Cos1].
  destruct (approx_sin_at P j t2 HP E) as [_ Cos2].
  apply approx_ext with (fun a b => (l + - r) + (U a b * (P a b - A a b) +
    (cos (P a b) - cos (A a b) + (sin (A a b) * (P a b - A a b) +
    (-1 / 2 * f) * ((P a b - A a b) * (P a b - A a b)))))).
  { intros. unfold past, Flight.pos. field. }
  close_jets jg2; assumption.
Qed.

(** ** Newton's method *)

Record guess (n : nat) (X : R -> R -> R) (t : R) (P : R -> R -> R) (j : jet R) : Prop := {
  g_jet : approx 4 P j; g_c00 : c00 j = t; g_0 : P 0 0 = t;
  g_near : order 1 (fun a b => P a b - t); g_gap : order n (fun a b => P a b - X a b) }.

Lemma guess_0 : forall X t, order 1 (fun a b => X a b - t) ->
  guess 1 X t (fun _ _ => t) (jconst real t).
Proof.
  intros X t HX. split; auto.
  - apply approx_const.
  - apply order_ext with (fun _ _ => 0). intros; ring. apply order_zero.
  - apply order_ext with (fun a b => (-1) * (X a b - t)). intros; ring. apply order_scal, HX.
Qed.

Lemma guess_next : forall n X t P Q j k, order 1 (fun a b => X a b - t) ->
  approx 4 Q k -> Q 0 0 = t -> order (S n) (fun a b => Q a b - X a b) -> guess n X t P j ->
  guess (S n) X t Q (jset t k).
Proof.
  intros n X t P Q j k HX HQ E HG' _. split; auto.
  - apply approx_set; auto.
  - destruct k. reflexivity.
  - apply order_ext with (fun a b => (Q a b - X a b) + (X a b - t)). intros; ring.
    apply order_plus. 2: exact HX. apply order_weaken with (2 := HG'). lia.
Qed.

Lemma guess_last : forall X t P j, guess 4 X t P j -> approx 4 X j.
Proof. intros X t P j Hg. apply approx_close with P; apply Hg. Qed.

Lemma Lipschitz1 : forall t' x' v' : R, Rabs (vel 1 0 v' t' - u1) <=
  (1 + Rabs f) * (Rabs (t' - t1) + Rabs (x' - x) + Rabs (v' - v)).
Proof.
  intros t' x' v'. assert (Q := vel_Lipschitz f 1 0 v t1 0 v' t' Rabs_R1).
  rewrite Rminus_eq_0, Rabs_R0 in Q. assert (P := Rabs_pos (x' - x)). assert (L := Lip_pos f).
  eapply Rle_trans. exact Q. apply Rmult_le_compat_l; lra.
Qed.

Lemma Lipschitz2 : forall t' a b : R, Rabs (- vel (-1) a (- b) t' - u2) <=
  (1 + Rabs f) * (Rabs (t' - t2) + Rabs (a - t1) + Rabs (b - u1)).
Proof.
  intros t' a b.
  assert (Q := vel_Lipschitz f (-1) t1 (- u1) t2 a (- b) t' (proj2 one_or_minus_one)).
  replace (- b - - u1) with (- (b - u1)) in Q by ring. rewrite Rabs_Ropp in Q.
  unfold u2, after2. fold u1.
  replace (- vel (-1) a (- b) t' - - vel (-1) t1 (- u1) t2)
    with (- (vel (-1) a (- b) t' - vel (-1) t1 (- u1) t2)) by ring.
  rewrite Rabs_Ropp. exact Q.
Qed.

Lemma guess_step1 : forall n P j, guess n A t1 P j ->
  exists Q, guess (S n) A t1 Q (step1 R real e j).
Proof.
  intros n P j Hg. destruct forward as [U1 _]. assert (L := Lip_pos f).
  assert (N := Newton (fun t a b => pos 1 0 a b t - r) (fun t _ b => vel 1 0 b t) t1 x v u1
    (1 + Rabs f) (slope1 f r) ltac:(lra) ltac:(lra) Lipschitz1 A (fun a _ => x + a)
    (fun _ b => v + b) A_near (proj1 shift_near) (proj2 shift_near) root1 n P (g_near _ _ _ _ _ Hg)
    (g_gap _ _ _ _ _ Hg)).
  exists (fun a b => P a b - / u1 * (pos 1 0 (x + a) (v + b) (P a b) - r)).
  apply guess_next with (5 := Hg). exact A_near.
  - apply approx_minus. apply Hg. apply approx_scal, approx_g1; apply Hg.
  - rewrite (g_0 _ _ _ _ _ Hg), !Rplus_0_r, (p_right _ _ _ _ _ _ _ orbit). ring.
  - apply order_ext with (2 := N). intros. simpl. ring.
Qed.

Lemma guess_step2 : forall n P j jA jU, approx 4 A jA -> c00 jA = t1 -> approx 4 U jU ->
  guess n B t2 P j -> exists Q, guess (S n) B t2 Q (step2 R real e jA jU j).
Proof.
  intros n P j jA jU HA EA HU Hg. destruct forward as [_ U2]. assert (L := Lip_pos f).
  destruct at_0 as (A0 & U0 & _).
  assert (N := Newton (past f l r) (fun t a b => - vel (-1) a (- b) t) t2 t1 u1 u2
    (1 + Rabs f) (slope2 f l r) ltac:(lra) ltac:(lra) Lipschitz2 B A U B_near A_near U_near
    root2 n P (g_near _ _ _ _ _ Hg) (g_gap _ _ _ _ _ Hg)).
  exists (fun a b => P a b - / u2 * past f l r (P a b) (A a b) (U a b)).
  apply guess_next with (5 := Hg). exact B_near.
  - apply approx_minus. apply Hg. apply approx_scal, approx_g2; try assumption; apply Hg.
  - rewrite (g_0 _ _ _ _ _ Hg), A0, U0. unfold past, u1.
    rewrite (p_left _ _ _ _ _ _ _ orbit). ring.
  - apply order_ext with (2 := N). intros. simpl. ring.
Qed.

(** ** The result *)

Lemma approx_A : approx 4 A (jt1 R real e) /\ c00 (jt1 R real e) = t1.
Proof.
  destruct (guess_step1 _ _ _ (guess_0 A t1 A_near)) as [P1 G1].
  destruct (guess_step1 _ _ _ G1) as [P2 G2]. destruct (guess_step1 _ _ _ G2) as [P3 G3].
  split. exact (guess_last _ _ _ _ G3). exact (g_c00 _ _ _ _ _ G3).
Qed.

Lemma approx_U : approx 4 U (jspeed1 R real e (jt1 R real e)).
Proof.
  destruct approx_A as [HA EA]. destruct (approx_sin_at A _ t1 HA EA) as [Sin _].
  apply approx_ext with (fun a b => (v + b) + (sin (A a b) - f * A a b)).
  { intros. unfold U, after1, Flight.vel. rewrite sin_0. ring. }
  close_jets jspeed1; assumption.
Qed.

Notation jA := (jt1 R real e).
Notation jU := (jspeed1 R real e (jt1 R real e)).
Notation jB := (jt2 R real e jA jU).

Lemma approx_B : approx 4 B jB /\ c00 jB = t2.
Proof.
  destruct approx_A as [HA EA]. assert (HU := approx_U).
  destruct (guess_step2 _ _ _ _ _ HA EA HU (guess_0 B t2 B_near)) as [P1 G1].
  destruct (guess_step2 _ _ _ _ _ HA EA HU G1) as [P2 G2].
  destruct (guess_step2 _ _ _ _ _ HA EA HU G2) as [P3 G3].
  split. exact (guess_last _ _ _ _ G3). exact (g_c00 _ _ _ _ _ G3).
Qed.

Lemma approx_W : approx 4 W (jspeed2 R real e jA jU jB).
Proof.
  destruct approx_A as [HA EA]. destruct approx_B as [HB EB]. assert (HU := approx_U).
  destruct (approx_sin_at A _ t1 HA EA) as [Sin1 _].
  destruct (approx_sin_at B _ t2 HB EB) as [Sin2 _].
  apply approx_ext with (fun a b => U a b + (sin (A a b) + f * A a b - (sin (B a b) + f * B a b))).
  { intros. unfold W, after2, U, Flight.vel. ring. }
  close_jets jspeed2; assumption.
Qed.

Lemma final_expands : forall jB jW, approx 4 B jB -> c00 jB = t2 -> approx 4 W jW ->
  expands (fun a b => end_x f l b (H a b) (G a b)) x v (final_x R real e jB jW) /\
  expands (fun a b => end_v f b (H a b) (G a b)) x v (final_v R real e jB jW).
Proof.
  intros jB jW HB EB HW. destruct (approx_sin_at B _ t2 HB EB) as [Sin Cos]. split.
  - apply approx_ext with (fun a b => (l + -1) + (W a b * (T - B a b) +
      (cos (B a b) - sin (B a b) * (T - B a b) +
       (-1 / 2 * f) * ((T - B a b) * (T - B a b))))).
    { intros. unfold end_x, Flight.pos. fold (A a b) (B a b). fold (W a b).
      rewrite cos_2PI. field. }
    close_jets final_x; assumption.
  - apply approx_ext with (fun a b => W a b - sin (B a b) - f * (T - B a b)).
    { intros. unfold end_v, Flight.vel. fold (A a b) (B a b). fold (W a b).
      rewrite sin_2PI. ring. }
    close_jets final_v; assumption.
Qed.

Theorem map_expands :
  expands (fun a b => end_x f l b (H a b) (G a b)) x v (fst (jmap real e)) /\
  expands (fun a b => end_v f b (H a b) (G a b)) x v (snd (jmap real e)).
Proof. apply final_expands. apply approx_B. apply approx_B. apply approx_W. Qed.

End Expansion.
