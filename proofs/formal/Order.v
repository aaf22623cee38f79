(** * Orders of smallness

    [order n f]: |f(a, b)| <= K max(|a|, |b|)^n around 0.  Orders add up in products; a function that
    is differentiable changes by O(1). *)

From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Plane.
Open Scope R_scope.

Lemma size_pos : forall a b, 0 <= size a b.
Proof. intros. apply Rle_trans with (Rabs a). apply Rabs_pos. apply Rmax_l. Qed.

Lemma order_ext : forall n f g, (forall a b, f a b = g a b) -> order n f -> order n g.
Proof.
  intros n f g E (K & d & HK & Hd & Hd1 & H). exists K, d. repeat split; auto.
  intros a b Hs. rewrite <- E. auto.
Qed.

Lemma order_local : forall n f g d, 0 < d -> (forall a b, size a b < d -> f a b = g a b) ->
  order n f -> order n g.
Proof.
  intros n f g e He E (K & d & HK & Hd & Hd1 & H).
  assert (A := Rmin_l e d). assert (B := Rmin_r e d).
  exists K, (Rmin e d). repeat split; auto. apply Rmin_glb_lt; lra. lra.
  intros a b Hs. rewrite <- E by lra. apply H. lra.
Qed.

Lemma order_plus : forall n f g, order n f -> order n g -> order n (fun a b => f a b + g a b).
Proof.
  intros n f g (K & d & HK & Hd & Hd1 & H) (K' & d' & HK' & Hd' & Hd1' & H').
  assert (A := Rmin_l d d'). assert (B := Rmin_r d d').
  exists (K + K'), (Rmin d d'). repeat split; try lra. apply Rmin_glb_lt; lra.
  intros a b Hs. assert (Q := H a b ltac:(lra)). assert (Q' := H' a b ltac:(lra)).
  eapply Rle_trans. apply Rabs_triang. lra.
Qed.

Lemma order_mult : forall n k f g, order n f -> order k g -> order (n + k) (fun a b => f a b * g a b).
Proof.
  intros n k f g (K & d & HK & Hd & Hd1 & H) (K' & d' & HK' & Hd' & Hd1' & H').
  assert (A := Rmin_l d d'). assert (B := Rmin_r d d').
  exists (K * K'), (Rmin d d'). repeat split; try lra. nra. apply Rmin_glb_lt; lra.
  intros a b Hs. assert (Q := H a b ltac:(lra)). assert (Q' := H' a b ltac:(lra)).
  rewrite Rabs_mult, pow_add.
  replace (K * K' * (size a b ^ n * size a b ^ k)) with
    ((K * size a b ^ n) * (K' * size a b ^ k)) by ring.
  apply Rmult_le_compat; auto using Rabs_pos.
Qed.

Lemma order_weaken : forall n k f, (k <= n)%nat -> order n f -> order k f.
Proof.
  intros n k f L (K & d & HK & Hd & Hd1 & H). exists K, d. repeat split; auto.
  intros a b Hs. eapply Rle_trans. apply H, Hs. apply Rmult_le_compat_l. exact HK.
  replace n with (k + (n - k))%nat by lia. rewrite pow_add.
  assert (P := size_pos a b).
  rewrite <- (Rmult_1_r (size a b ^ k)) at 2. apply Rmult_le_compat_l. apply pow_le, P.
  rewrite <- (pow1 (n - k)). apply pow_incr. lra.
Qed.

Lemma order_const : forall c, order 0 (fun _ _ => c).
Proof.
  intros c. exists (Rabs c), 1. repeat split; try lra. apply Rabs_pos.
  intros. simpl. lra.
Qed.

Lemma order_zero : forall n, order n (fun _ _ => 0).
Proof.
  intros n. exists 0, 1. repeat split; try lra. intros a b _. rewrite Rabs_R0. lra.
Qed.

Lemma order_a : order 1 (fun a _ => a).
Proof.
  exists 1, 1. repeat split; try lra. intros a b _. simpl. rewrite Rmult_1_l, Rmult_1_r. apply Rmax_l.
Qed.

Lemma order_b : order 1 (fun _ b => b).
Proof.
  exists 1, 1. repeat split; try lra. intros a b _. simpl. rewrite Rmult_1_l, Rmult_1_r. apply Rmax_r.
Qed.

Lemma order_scal : forall n c f, order n f -> order n (fun a b => c * f a b).
Proof. intros n c f H. exact (order_mult 0 n _ f (order_const c) H). Qed.

Lemma order_minus : forall n f g, order n f -> order n g -> order n (fun a b => f a b - g a b).
Proof.
  intros n f g Hf Hg. apply order_ext with (fun a b => f a b + (-1) * g a b). intros; ring.
  apply order_plus. exact Hf. apply order_scal, Hg.
Qed.

(** Something bounded by a power of something small. *)

Lemma order_bound : forall n f g K d, 0 <= K -> 0 < d -> order n g ->
  (forall a b, size a b < d -> Rabs (f a b) <= K * Rabs (g a b)) -> order n f.
Proof.
  intros n f g K e HK0 He (K' & d & HK & Hd & Hd1 & H) Hb.
  assert (A := Rmin_l e d). assert (B := Rmin_r e d).
  exists (K * K'), (Rmin e d). repeat split; try lra. nra. apply Rmin_glb_lt; lra.
  intros a b Hs. eapply Rle_trans. apply Hb. lra. rewrite Rmult_assoc.
  apply Rmult_le_compat_l. exact HK0. apply H. lra.
Qed.

Lemma order_small : forall f e, order 1 f -> 0 < e -> exists d, 0 < d /\
  forall a b, size a b < d -> Rabs (f a b) < e.
Proof.
  intros f e (K & d & HK & Hd & Hd1 & H) He.
  assert (P : 0 < e / (K + 1)) by (apply Rdiv_lt_0_compat; lra).
  assert (A := Rmin_l d (e / (K + 1))). assert (B := Rmin_r d (e / (K + 1))).
  exists (Rmin d (e / (K + 1))). split. apply Rmin_glb_lt; lra.
  intros a b Hs. eapply Rle_lt_trans. apply H. lra. simpl. rewrite Rmult_1_r.
  assert (S := size_pos a b).
  apply Rle_lt_trans with ((K + 1) * size a b). nra.
  apply Rlt_le_trans with ((K + 1) * (e / (K + 1))). apply Rmult_lt_compat_l; lra.
  right. field. lra.
Qed.

Lemma order_1_of_D2 : forall f x y p q, differentiable_pt_lim f x y p q ->
  order 1 (fun a b => f (x + a) (y + b) - f x y).
Proof.
  intros f x y p q H. destruct (H (mkposreal 1 Rlt_0_1)) as [d Hd]. simpl in Hd.
  assert (A := Rmin_l 1 d). assert (B := Rmin_r 1 d).
  exists (1 + Rabs p + Rabs q), (Rmin 1 d). assert (Pp := Rabs_pos p). assert (Pq := Rabs_pos q).
  repeat split; try lra. apply Rmin_glb_lt. lra. apply cond_pos.
  intros a b Hs. assert (Sa : Rabs a <= size a b) by apply Rmax_l.
  assert (Sb : Rabs b <= size a b) by apply Rmax_r.
  assert (Q := Hd (x + a) (y + b)).
  replace (x + a - x) with a in Q by ring. replace (y + b - y) with b in Q by ring.
  specialize (Q ltac:(lra) ltac:(lra)). fold (size a b) in Q.
  replace (f (x + a) (y + b) - f x y) with
    ((f (x + a) (y + b) - f x y - (p * a + q * b)) + (p * a + q * b)) by ring.
  eapply Rle_trans. apply Rabs_triang.
  assert (L : Rabs (p * a + q * b) <= (Rabs p + Rabs q) * size a b).
  { eapply Rle_trans. apply Rabs_triang. rewrite !Rabs_mult. nra. }
  simpl. lra.
Qed.
