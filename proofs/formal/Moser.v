(** * Stability, if Moser's theorem holds

    Close to the fixed point the map (X, V) is the map of the period, so what Moser's theorem says of
    it is said of the motions. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement.
Open Scope R_scope.

Section Moser.

Variables (X V : R -> R -> R) (x v : R) (relation : R -> R -> R -> R -> Prop).
Hypothesis here : locally_2d (fun a b => relation a b (X a b) (V a b)) x v.

Let step a b y z := y = X a b /\ z = V a b.

Lemma close_enough : exists d, 0 < d /\ forall a b, size (a - x) (b - v) < d ->
  relation a b (X a b) (V a b).
Proof.
  destruct here as [d H]. exists d. split. apply cond_pos. intros a b Hs. apply H.
  apply Rle_lt_trans with (2 := Hs). apply Rmax_l. apply Rle_lt_trans with (2 := Hs). apply Rmax_r.
Qed.

Lemma stable_transfer : stable step x v -> stable relation x v.
Proof.
  intros S eps He. destruct close_enough as [e [He' C]].
  assert (L1 := Rmin_l eps e). assert (L2 := Rmin_r eps e).
  destruct (S (Rmin eps e)) as [d [Hd H]]. apply Rmin_glb_lt; assumption.
  exists d. split. exact Hd. intros a b Hs. destruct (H a b Hs) as (p & q & P0 & Q0 & Steps).
  exists p, q. split. exact P0. split. exact Q0. intros n. destruct (Steps n) as [[E1 E2] Near].
  split. rewrite E1, E2. apply C. lra. lra.
Qed.

Lemma curves_transfer : invariant_curves step x v -> invariant_curves relation x v.
Proof.
  intros S eps He. destruct close_enough as [e [He' C]].
  assert (L1 := Rmin_l eps e). assert (L2 := Rmin_r eps e).
  destruct (S (Rmin eps e)) as (m & n & p & q & rho & Det & Curve & Small & Into & Onto).
  apply Rmin_glb_lt; assumption.
  exists m, n, p, q, rho. split. exact Det. split. exact Curve.
  split. { intros s. specialize (Small s). simpl in *. lra. }
  split.
  - intros s. destruct (Into s) as [s' [E1 E2]]. exists s'. rewrite E1, E2. apply C.
    specialize (Small s). simpl in *. lra.
  - intros s'. destruct (Onto s') as [s [E1 E2]]. exists s. rewrite E1, E2. apply C.
    specialize (Small s). simpl in *. lra.
Qed.

Theorem stable_if_Moser : forall Theta tau, X x v = x -> V x v = v -> smooth X x v -> smooth V x v ->
  preserves_area X V x v -> normal_form X V x v Theta tau -> nonresonant Theta -> tau <> 0 ->
  Moser_twist_theorem -> stable relation x v /\ invariant_curves relation x v.
Proof.
  intros Theta tau FX FV SX SV Area NF NR Ht M.
  destruct (M X V x v Theta tau FX FV SX SV Area NF NR Ht) as [S K].
  split. apply stable_transfer, S. apply curves_transfer, K.
Qed.

End Moser.
