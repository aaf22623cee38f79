(** * Newton's method gains an order at each step

    Let g(T, X, Y) = 0 for T, X, Y that change by O(1).  If P = T + O(n), then

      P - g(P, X, Y) / m = T + O(n + 1),    m = dg/dt at the centre:

    the difference is (m - dg/dt(c)) (P - T) / m, c between P and T, and m - dg/dt(c) = O(1). *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Order.
Open Scope R_scope.

Section Newton.

Variables (g g' : R -> R -> R -> R) (t x y m L : R).
Hypothesis slope : forall t x y, is_derive (fun s => g s x y) t (g' t x y).
Hypothesis m_not_0 : m <> 0.
Hypothesis L_pos : 0 <= L.
Hypothesis Lipschitz : forall t' x' y',
  Rabs (g' t' x' y' - m) <= L * (Rabs (t' - t) + Rabs (x' - x) + Rabs (y' - y)).

Variables (T X Y : R -> R -> R).
Hypothesis T_near : order 1 (fun a b => T a b - t).
Hypothesis X_near : order 1 (fun a b => X a b - x).
Hypothesis Y_near : order 1 (fun a b => Y a b - y).
Hypothesis root : exists d, 0 < d /\ forall a b, size a b < d -> g (T a b) (X a b) (Y a b) = 0.

Lemma Newton : forall n P, order 1 (fun a b => P a b - t) -> order n (fun a b => P a b - T a b) ->
  order (S n) (fun a b => P a b + (- / m) * g (P a b) (X a b) (Y a b) - T a b).
Proof.
  intros n P HP HT. destruct root as [d [Hd Hr]].
  assert (B : order 1 (fun a b => Rabs (P a b - t) + Rabs (T a b - t) + Rabs (X a b - x)
                              + Rabs (Y a b - y))).
  { assert (A : forall h, order 1 h -> order 1 (fun a b => Rabs (h a b))).
    { intros h Hh. apply order_bound with h 1 1; try lra. exact Hh.
      intros. rewrite Rabs_Rabsolu. lra. }
    repeat apply order_plus; apply A; assumption. }
  assert (C := order_mult 1 n _ _ B HT).
  apply order_bound with (3 := C) (K := Rabs (/ m) * L) (d := d). 2: exact Hd.
  { apply Rmult_le_pos. apply Rabs_pos. exact L_pos. }
  intros a b Hab.
  destruct (MVT_gen (fun s => g s (X a b) (Y a b)) (T a b) (P a b)
              (fun s => g' s (X a b) (Y a b))) as [c [Hc E]].
  { intros. apply slope. }
  { intros. apply continuity_pt_filterlim.
    apply (ex_derive_continuous (fun s => g s (X a b) (Y a b))). eexists. apply slope. }
  simpl in E. rewrite (Hr a b Hab), Rminus_0_r in E.
  replace (P a b + - / m * g (P a b) (X a b) (Y a b) - T a b)
    with (/ m * (- (g' c (X a b) (Y a b) - m)) * (P a b - T a b)).
  2: { rewrite E. field. exact m_not_0. }
  rewrite !Rabs_mult, Rabs_Ropp. rewrite Rmult_assoc, (Rmult_assoc (Rabs (/ m))).
  apply Rmult_le_compat_l. apply Rabs_pos. rewrite <- Rmult_assoc.
  apply Rmult_le_compat_r. apply Rabs_pos.
  eapply Rle_trans. apply Lipschitz. apply Rmult_le_compat_l. exact L_pos.
  rewrite (Rabs_pos_eq (_ + _ + _ + _)).
  2: { repeat apply Rplus_le_le_0_compat; apply Rabs_pos. }
  assert (Hct : Rabs (c - t) <= Rabs (P a b - t) + Rabs (T a b - t)).
  { assert (R1 := Rle_abs (P a b - t)). assert (R2 := Rle_abs (T a b - t)).
    assert (R3 := Rle_abs (- (P a b - t))). assert (R4 := Rle_abs (- (T a b - t))).
    rewrite Rabs_Ropp in R3, R4. apply Rabs_le.
    destruct (Rle_dec (T a b) (P a b)) as [Q | Q].
    rewrite Rmin_left, Rmax_right in Hc by lra. lra.
    rewrite Rmin_right, Rmax_left in Hc by lra. lra. }
  lra.
Qed.

End Newton.
