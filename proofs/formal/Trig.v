(** * Sine and cosine of a function that is known up to O(4)

    If s = O(1), then sin(c + s) = sin c (1 - s^2/2) + cos c (s - s^3/6) + O(4), and so for cos. *)

From Coq Require Import Reals Lra Lia.
From Cap Require Import Statement Order Jet.
Open Scope R_scope.

Lemma cos_near_0 : forall s, -2 <= s <= 2 -> Rabs (cos s - (1 - s * s / 2)) <= s * s * s * s.
Proof.
  intros s Hs. destruct (pre_cos_bound s 0) as [A B]; try lra.
  unfold cos_approx, cos_term in A, B. simpl in A, B.
  assert (Q : 0 <= s * s) by nra. apply Rabs_le.
  assert (Q4 : 0 <= s * s * s * s) by nra. lra.
Qed.

Lemma sin_near_0_pos : forall s, 0 <= s <= 1 -> Rabs (sin s - (s - s * s * s / 6)) <= s * s * s * s.
Proof.
  intros s Hs. destruct (pre_sin_bound s 0) as [A B]; try lra.
  unfold sin_approx, sin_term in A, B. simpl in A, B.
  assert (Q : 0 <= s * s * s * s) by (repeat apply Rmult_le_pos; lra).
  assert (Q5 : s * s * s * s * s <= s * s * s * s).
  { rewrite <- (Rmult_1_r (s * s * s * s)) at 2. apply Rmult_le_compat_l; lra. }
  assert (Q6 : 0 <= s * s * s * s * s) by (apply Rmult_le_pos; lra).
  apply Rabs_le. lra.
Qed.

Lemma sin_near_0 : forall s, -1 <= s <= 1 -> Rabs (sin s - (s - s * s * s / 6)) <= s * s * s * s.
Proof.
  intros s Hs. destruct (Rle_dec 0 s) as [L | L].
  - apply sin_near_0_pos. lra.
  - assert (A := sin_near_0_pos (- s) ltac:(lra)). rewrite sin_neg in A.
    replace (- s * - s * - s * - s) with (s * s * s * s) in A by ring.
    rewrite <- Rabs_Ropp.
    replace (- (sin s - (s - s * s * s / 6))) with (- sin s - (- s - - s * - s * - s / 6)) by field.
    exact A.
Qed.

Lemma approx_small : forall n f j, (1 <= n)%nat -> approx n f j ->
  approx n (fun a b => f a b - c00 j) (jsmall real j) /\ order 1 (fun a b => f a b - c00 j).
Proof.
  intros n f j Hn H.
  assert (A : approx n (fun a b => f a b - c00 j) (jsmall real j)).
  { apply order_ext with (2 := H). intros. destruct j. unfold_ev. ring. }
  split. exact A.
  apply order_ext with (fun a b => (f a b - ev j a b) + (p1 j a b + p2 j a b + p3 j a b)).
  { intros. rewrite ev_is. ring. }
  apply order_plus. apply order_weaken with (2 := H). lia.
  apply order_plus. apply order_plus. apply order_p1.
  apply order_weaken with (2 := order_p2 j). lia. apply order_weaken with (2 := order_p3 j). lia.
Qed.

Lemma jsquare_is : forall j, jmult real (jsmall real j) (jsmall real j) = jsquare real j.
Proof. intros j. destruct j. simpl. f_equal; ring. Qed.

Lemma jcube_is : forall j,
  jmult real (jmult real (jsmall real j) (jsmall real j)) (jsmall real j) = jcube real j.
Proof. intros j. destruct j. simpl. f_equal; ring. Qed.

Section Trig.

Variables (f : R -> R -> R) (j : jet R).
Hypothesis H : approx 4 f j.
Let s (a b : R) := f a b - c00 j.

Lemma order_rest : order 4 (fun a b => cos (s a b) - (1 - s a b * s a b / 2)) /\
                   order 4 (fun a b => sin (s a b) - (s a b - s a b * s a b * s a b / 6)).
Proof.
  destruct (approx_small 4 f j ltac:(lia) H) as [_ B]. fold s in B.
  assert (B4 : order 4 (fun a b => s a b * s a b * s a b * s a b)).
  { exact (order_mult 3 1 _ _ (order_mult 2 1 _ _ (order_mult 1 1 _ _ B B) B) B). }
  destruct (order_small _ 1 B Rlt_0_1) as [d [Hd Hs]].
  assert (E : forall a b, size a b < d -> -1 <= s a b <= 1).
  { intros a b Hab. assert (Q : Rabs (s a b) < 1) by exact (Hs a b Hab). apply Rabs_def2 in Q. lra. }
  split; apply order_bound with (fun a b => s a b * s a b * s a b * s a b) 1 d; auto; try lra;
    intros a b Hab; assert (Q := E a b Hab); rewrite Rmult_1_l.
  - eapply Rle_trans. apply cos_near_0. lra. apply Rle_abs.
  - eapply Rle_trans. apply sin_near_0. lra. apply Rle_abs.
Qed.

Lemma approx_cos_s : approx 4 (fun a b => cos (s a b)) (jeven real j).
Proof.
  destruct (approx_small 4 f j ltac:(lia) H) as [A _].
  apply approx_close with (fun a b => 1 + (-1 / 2) * (s a b * s a b)).
  - apply approx_plus. apply approx_const. apply approx_scal. rewrite <- jsquare_is.
    apply approx_mult; auto.
  - apply order_ext with (fun a b => (-1) * (cos (s a b) - (1 - s a b * s a b / 2))).
    intros; field. apply order_scal, order_rest.
Qed.

Lemma approx_sin_s : approx 4 (fun a b => sin (s a b)) (jodd real j).
Proof.
  destruct (approx_small 4 f j ltac:(lia) H) as [A _].
  apply approx_close with (fun a b => s a b + (-1 / 6) * (s a b * s a b * s a b)).
  - apply approx_plus. exact A. apply approx_scal. rewrite <- jcube_is.
    apply approx_mult; auto. apply approx_mult; auto.
  - apply order_ext with (fun a b => (-1) * (sin (s a b) - (s a b - s a b * s a b * s a b / 6))).
    intros; field. apply order_scal, order_rest.
Qed.

Lemma approx_sin : approx 4 (fun a b => sin (f a b)) (jsin real (sin (c00 j)) (cos (c00 j)) j).
Proof.
  apply approx_ext with (fun a b => sin (c00 j) * cos (s a b) + cos (c00 j) * sin (s a b)).
  { intros. replace (f a b) with (c00 j + s a b) by (unfold s; ring). rewrite sin_plus. ring. }
  apply approx_plus; apply approx_scal. apply approx_cos_s. apply approx_sin_s.
Qed.

Lemma approx_cos : approx 4 (fun a b => cos (f a b)) (jcos real (sin (c00 j)) (cos (c00 j)) j).
Proof.
  apply approx_ext with (fun a b => cos (c00 j) * cos (s a b) + (- sin (c00 j)) * sin (s a b)).
  { intros. replace (f a b) with (c00 j + s a b) by (unfold s; ring). rewrite cos_plus. ring. }
  apply approx_plus; apply approx_scal. apply approx_cos_s. apply approx_sin_s.
Qed.

End Trig.
