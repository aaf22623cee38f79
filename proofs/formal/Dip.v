(** * Where the speed on a flight is least

    On a flight to the right the speed is h(t) = c + sin t - f t, and so it is on a flight to the
    left if time is shifted by pi.  For 0 < f < 1 let cos a = f, 0 < a < pi/2: h decreases from a to
    m = 2 pi - a, increases to m + 2 a and decreases from there to m + 2 pi.  So on [A, B], if
    a <= A and B <= m + 2 pi, it is nowhere less than at B and at the point of [A, B] nearest m. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Plane OneOne.
Open Scope R_scope.

Section Dip.

Variables f c : R.
Hypothesis f_small : 0 < f < 1.

Definition turn : R := PI / 2 - atan (f / sqrt (1 - f * f)).
Definition low : R := 2 * PI - turn.
Definition h (t : R) : R := c + sin t - f * t.

Lemma turn_is : cos turn = f /\ sin turn = sqrt (1 - f * f) /\ 0 < turn < PI / 2.
Proof.
  assert (Q : 0 < 1 - f * f) by nra. assert (P := sqrt_lt_R0 _ Q).
  assert (E : sqrt (1 - f * f) * sqrt (1 - f * f) + f * f = 1) by (rewrite sqrt_sqrt; lra).
  destruct (angle_of_is f _ P E) as [Es Ec]. unfold angle_of in Es, Ec.
  rewrite sin_neg in Es. rewrite cos_neg in Ec.
  unfold turn. rewrite cos_shift, sin_shift. split. lra. split. exact Ec.
  assert (B := atan_bound (f / sqrt (1 - f * f))).
  assert (0 < atan (f / sqrt (1 - f * f))). 2: lra.
  rewrite <- atan_0. apply atan_increasing, Rdiv_lt_0_compat; lra.
Qed.

Lemma h_derive : forall t, is_derive h t (cos t - f).
Proof. intros t. unfold h. auto_derive. exact I. ring. Qed.

Lemma h_mono : forall s x y, x <= y -> (forall t, x <= t <= y -> 0 <= s * (cos t - f)) ->
  s * h x <= s * h y.
Proof.
  intros s x y Hxy Pos. destruct (MVT_between h (fun t => cos t - f) x y h_derive) as [z [Hz E]].
  rewrite Rmin_left, Rmax_right in Hz by lra. assert (A := Pos z Hz).
  assert (Q : s * h y - s * h x = (s * (cos z - f)) * (y - x)) by (rewrite <- Rmult_minus_distr_l, E; ring).
  assert (0 <= (s * (cos z - f)) * (y - x)) by (apply Rmult_le_pos; lra). lra.
Qed.

(** The sign of cos t - f, period after period. *)

Lemma cos_small : forall t, turn <= t <= low -> cos t <= f.
Proof.
  intros t Ht. destruct turn_is as (Ec & _ & B). unfold low in Ht. rewrite <- Ec.
  destruct (Rle_dec t PI) as [L | L].
  - apply cos_decr_1; lra.
  - replace (cos t) with (cos (2 * PI - t)). apply cos_decr_1; lra.
    rewrite cos_minus, cos_2PI, sin_2PI. ring.
Qed.

Lemma cos_large : forall t, low <= t <= low + 2 * turn -> f <= cos t.
Proof.
  intros t Ht. destruct turn_is as (Ec & _ & B). unfold low in Ht. rewrite <- Ec.
  replace (cos t) with (cos (t - 2 * PI)).
  2: { rewrite cos_minus, cos_2PI, sin_2PI. ring. }
  destruct (Rle_dec (2 * PI) t) as [L | L].
  - apply cos_decr_1; lra.
  - rewrite <- (cos_neg (t - 2 * PI)). apply cos_decr_1; lra.
Qed.

Lemma falls : forall x y, turn <= x -> x <= y -> y <= low -> h y <= h x.
Proof.
  intros x y Hx Hxy Hy. assert (A := h_mono (-1) x y Hxy).
  assert (-1 * h x <= -1 * h y). 2: lra.
  apply A. intros t Ht. assert (Q := cos_small t ltac:(lra)). lra.
Qed.

Lemma rises : forall x y, low <= x -> x <= y -> y <= low + 2 * turn -> h x <= h y.
Proof.
  intros x y Hx Hxy Hy. assert (A := h_mono 1 x y Hxy).
  assert (1 * h x <= 1 * h y). 2: lra.
  apply A. intros t Ht. assert (Q := cos_large t ltac:(lra)). lra.
Qed.

Lemma falls_again : forall x y, low + 2 * turn <= x -> x <= y -> y <= low + 2 * PI -> h y <= h x.
Proof.
  intros x y Hx Hxy Hy. unfold low in *. assert (A := h_mono (-1) x y Hxy).
  assert (-1 * h x <= -1 * h y). 2: lra.
  apply A. intros t Ht. assert (Q := cos_small (t - 2 * PI) ltac:(unfold low; lra)).
  rewrite cos_minus, cos_2PI, sin_2PI in Q. lra.
Qed.

Variables A B : R.
Hypothesis order : turn <= A /\ A <= B /\ B <= low + 2 * PI.

Definition lowest : R := Rmax A (Rmin low B).

Theorem dip : forall t, A <= t <= B -> Rmin (h lowest) (h B) <= h t.
Proof.
  intros t Ht. destruct turn_is as (_ & _ & Bt).
  assert (L1 := Rmin_l (h lowest) (h B)). assert (L2 := Rmin_r (h lowest) (h B)).
  destruct (Rle_dec t low) as [Lt | Lt].
  - (* t before the dip: h falls to [lowest] *)
    assert (h (Rmin low B) <= h t).
    { apply falls. lra. apply Rmin_glb; lra. apply Rmin_l. }
    unfold lowest in *. rewrite Rmax_right in * by (apply Rle_trans with t; [lra | apply Rmin_glb; lra]).
    lra.
  - (* after it: h rises, then falls *)
    assert (Le : low <= lowest <= t).
    { unfold lowest. rewrite (Rmin_left low B) by lra. split. apply Rmax_r. apply Rmax_lub; lra. }
    destruct (Rle_dec t (low + 2 * turn)) as [Lu | Lu].
    + assert (h lowest <= h t) by (apply rises; lra). lra.
    + assert (h B <= h t) by (apply falls_again; lra). lra.
Qed.

End Dip.
