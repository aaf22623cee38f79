(** * Differentiable functions of two variables

    Coquelicot's [differentiable_pt_lim f x y p q], f(u, v) = f(x, y) + p (u - x) + q (v - y) + o,
    here [D2]: sums, products, compositions; and what holds around a point. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Limits.
Open Scope R_scope.

Notation D2 := differentiable_pt_lim.

Lemma D2_ext : forall f g x y p q p' q', D2 f x y p q ->
  (forall u v, f u v = g u v) -> p = p' -> q = q' -> D2 g x y p' q'.
Proof.
  intros f g x y p q p' q' H E -> ->. apply differentiable_pt_lim_ext with (2 := H).
  exists (mkposreal 1 Rlt_0_1). intros; apply E.
Qed.

Lemma D2_const : forall c x y, D2 (fun _ _ => c) x y 0 0.
Proof.
  intros c x y eps. exists (mkposreal 1 Rlt_0_1). intros u v _ _.
  replace (c - c - (0 * (u - x) + 0 * (v - y))) with 0 by ring. rewrite Rabs_R0.
  apply Rmult_le_pos. left. apply cond_pos.
  apply Rle_trans with (Rabs (u - x)). apply Rabs_pos. apply Rmax_l.
Qed.

Lemma D2_fst : forall x y, D2 (fun u _ => u) x y 1 0.
Proof.
  intros x y. apply (differentiable_pt_lim_proj1_0 (fun u => u)). apply derivable_pt_lim_id.
Qed.

Lemma D2_snd : forall x y, D2 (fun _ v => v) x y 0 1.
Proof.
  intros x y eps. exists (mkposreal 1 Rlt_0_1). intros u v _ _.
  replace (v - y - (0 * (u - x) + 1 * (v - y))) with 0 by ring. rewrite Rabs_R0.
  apply Rmult_le_pos. left. apply cond_pos.
  apply Rle_trans with (Rabs (u - x)). apply Rabs_pos. apply Rmax_l.
Qed.

Lemma D2_sum : forall x y, D2 (fun u v => u + v) x y 1 1.
Proof.
  intros x y eps. exists (mkposreal 1 Rlt_0_1). intros u v _ _.
  replace (u + v - (x + y) - (1 * (u - x) + 1 * (v - y))) with 0 by ring. rewrite Rabs_R0.
  apply Rmult_le_pos. left. apply cond_pos.
  apply Rle_trans with (Rabs (u - x)). apply Rabs_pos. apply Rmax_l.
Qed.

Lemma D2_product : forall x y, D2 (fun u v => u * v) x y y x.
Proof.
  intros x y eps. exists eps. intros u v Hu Hv.
  replace (u * v - x * y - (y * (u - x) + x * (v - y))) with ((u - x) * (v - y)) by ring.
  rewrite Rabs_mult. apply Rmult_le_compat; try apply Rabs_pos. lra. apply Rmax_r.
Qed.

Lemma D2_plus : forall f g x y p q p' q', D2 f x y p q -> D2 g x y p' q' ->
  D2 (fun u v => f u v + g u v) x y (p + p') (q + q').
Proof.
  intros f g x y p q p' q' Hf Hg.
  eapply D2_ext. eapply (differentiable_pt_lim_comp (fun u v => u + v) f g).
  apply D2_sum. exact Hf. exact Hg. reflexivity. ring. ring.
Qed.

Lemma D2_mult : forall f g x y p q p' q', D2 f x y p q -> D2 g x y p' q' ->
  D2 (fun u v => f u v * g u v) x y (p * g x y + f x y * p') (q * g x y + f x y * q').
Proof.
  intros f g x y p q p' q' Hf Hg.
  eapply D2_ext. eapply (differentiable_pt_lim_comp (fun u v => u * v) f g).
  apply D2_product. exact Hf. exact Hg. reflexivity. ring. ring.
Qed.

Lemma D2_apply : forall h f x y k p q, is_derive h (f x y) k -> D2 f x y p q ->
  D2 (fun u v => h (f u v)) x y (k * p) (k * q).
Proof.
  intros h f x y k p q Hh Hf.
  eapply D2_ext. eapply (differentiable_pt_lim_comp (fun u _ => h u) f (fun _ _ => 0)).
  apply differentiable_pt_lim_proj1_0. apply is_derive_Reals. exact Hh.
  exact Hf. apply D2_const. reflexivity. ring. ring.
Qed.

Lemma D2_continuous : forall f x y p q, D2 f x y p q -> continuity_2d_pt f x y.
Proof.
  intros f x y p q H. apply differentiable_continuity_pt. exists p, q. exact H.
Qed.

Lemma locally_2d_comp : forall (P : R -> R -> Prop) f g x y,
  locally_2d P (f x y) (g x y) -> continuity_2d_pt f x y -> continuity_2d_pt g x y ->
  locally_2d (fun u v => P (f u v) (g u v)) x y.
Proof.
  intros P f g x y [d HP] Hf Hg. destruct (Hf d) as [d1 H1]. destruct (Hg d) as [d2 H2].
  assert (D : 0 < Rmin d1 d2) by (apply Rmin_glb_lt; apply cond_pos).
  exists (mkposreal _ D). simpl. intros u v Hu Hv.
  assert (D1 := Rmin_l d1 d2). assert (D2 := Rmin_r d1 d2).
  apply HP. apply H1; lra. apply H2; lra.
Qed.

(** What holds around a point holds around the points near it. *)

Lemma ball_in_ball : forall (P : R -> R -> Prop) x v d a b,
  (forall u w, Rabs (u - x) < d -> Rabs (w - v) < d -> P u w) ->
  Rabs (a - x) < d -> Rabs (b - v) < d -> locally_2d P a b.
Proof.
  intros P x v d a b H Ha Hb.
  assert (D : 0 < Rmin (d - Rabs (a - x)) (d - Rabs (b - v))) by (apply Rmin_glb_lt; lra).
  exists (mkposreal _ D). simpl. intros u w Hu Hw.
  assert (L1 := Rmin_l (d - Rabs (a - x)) (d - Rabs (b - v))).
  assert (L2 := Rmin_r (d - Rabs (a - x)) (d - Rabs (b - v))).
  apply H.
  - replace (u - x) with ((u - a) + (a - x)) by ring. eapply Rle_lt_trans. apply Rabs_triang. lra.
  - replace (w - v) with ((w - b) + (b - v)) by ring. eapply Rle_lt_trans. apply Rabs_triang. lra.
Qed.

(** ** Sine and cosine *)

Lemma MVT_between : forall (h h' : R -> R) a b, (forall t, is_derive h t (h' t)) ->
  exists c, Rmin a b <= c <= Rmax a b /\ h b - h a = h' c * (b - a).
Proof.
  intros h h' a b H. apply MVT_gen.
  - intros. apply H.
  - intros. apply continuity_pt_filterlim, (ex_derive_continuous h). eexists. apply H.
Qed.

Lemma sin_Lipschitz : forall y z, Rabs (sin y - sin z) <= Rabs (y - z).
Proof.
  intros y z. destruct (MVT_between sin cos z y) as [c [_ E]]. intros; apply is_derive_sin.
  rewrite E, Rabs_mult. assert (B := COS_bound c). assert (P := Rabs_pos (y - z)).
  assert (Rabs (cos c) <= 1) by (apply Rabs_le; lra). nra.
Qed.
