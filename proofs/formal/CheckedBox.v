(** * The tests of the box say that the map exists on it and has one fixed point at most *)

From Coq Require Import Reals Lra Lia ZArith Bool List.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement OneOne Asymmetric Symmetric Box Units Enclosure Data EvalOrbit EvalBox Check
  CheckedUnits.
Open Scope R_scope.

Section Box.

Variables (n : orbit_data) (h : hints).
Hypothesis ok : good n.
Hypothesis tested : forallb snd (box_tests n h) = true.

Notation lambda := (lambda n).
Notation U := (U n).
Notation f := (f n).
Notation l := (l n).
Notation r := (r n).
Notation q := (Enclosure.F.PtoP (box_bits h)).
Notation the_setting := (eval_setting q (scaled_f n q) (scaled_l n q) (scaled_r n q)
  (window_1 h) (window_2 h) (d_box h) (kind_ h)).

Lemma edge_halves : forall a b k i x, (0 < k)%nat -> edge a b k i <= x <= edge a b k (S i) ->
  edge a b (2 * k) (2 * i) <= x <= edge a b (2 * k) (S (2 * i)) \/
  edge a b (2 * k) (S (2 * i)) <= x <= edge a b (2 * k) (S (S (2 * i))).
Proof.
  intros a b k i x Hk H. assert (K : 0 < INR k) by (apply lt_0_INR; exact Hk).
  assert (E0 : edge a b (2 * k) (2 * i) = edge a b k i).
  { unfold edge. rewrite !mult_INR. simpl (INR 2). field. lra. }
  assert (E2 : edge a b (2 * k) (S (S (2 * i))) = edge a b k (S i)).
  { replace (S (S (2 * i))) with (2 * S i)%nat by lia. unfold edge. rewrite !mult_INR. simpl (INR 2).
    field. lra. }
  rewrite E0, E2. destruct (Rle_dec x (edge a b (2 * k) (S (2 * i)))); lra.
Qed.

Lemma cover_ok : forall depth k i j, (0 < k)%nat -> windows_ok q the_setting = true ->
  cover n h depth the_setting (lam n q) (unit_U n q) k i j = true ->
  forall a b,
  edge (value (fst (box_x_ n))) (value (snd (box_x_ n))) k i <= lambda * a
    <= edge (value (fst (box_x_ n))) (value (snd (box_x_ n))) k (S i) ->
  edge (value (fst (box_v_ n))) (value (snd (box_v_ n))) k j <= U * b
    <= edge (value (fst (box_v_ n))) (value (snd (box_v_ n))) k (S j) ->
  hits_known f l r a b (value (fst (d_box h))) (value (snd (d_box h)))
    (phi_low (kind_ h)) (phi_high (kind_ h)).
Proof.
  assert (Hl := lambda_pos n ok). assert (HU := U_pos n ok). assert (Hf := f_small n ok).
  induction depth as [ | depth IH]; intros k i j Hk HW H a b Ha Hb.
  - unfold cover in H. destruct (cell_ok _ _ _ _) eqn:E; [ | discriminate].
    apply (cell_known q f l r (scaled_f n q) (scaled_l n q) (scaled_r n q) (window_1 h) (window_2 h)
      (d_box h) (kind_ h)
      _ _ a b Hf (inn_f n q) (inn_l n q) (inn_r n q) HW E).
    + replace a with (lambda * a / lambda) by (field; lra). apply inn_div. apply part_ok, Ha. apply inn_lam.
    + replace b with (U * b / U) by (field; lra). apply inn_div. apply part_ok, Hb. apply inn_U.
  - cbn [cover] in H. destruct (cell_ok _ _ _ _) eqn:E.
    + apply (cell_known q f l r (scaled_f n q) (scaled_l n q) (scaled_r n q) (window_1 h) (window_2 h)
      (d_box h) (kind_ h)
        _ _ a b Hf (inn_f n q) (inn_l n q) (inn_r n q) HW E).
      * replace a with (lambda * a / lambda) by (field; lra). apply inn_div. apply part_ok, Ha. apply inn_lam.
      * replace b with (U * b / U) by (field; lra). apply inn_div. apply part_ok, Hb. apply inn_U.
    + cbv zeta in H.
      destruct (cover n h depth the_setting (lam n q) (unit_U n q) (2 * k) (2 * i) (2 * j)) eqn:C1;
        [ | discriminate].
      destruct (cover n h depth the_setting (lam n q) (unit_U n q) (2 * k) (2 * i) (S (2 * j))) eqn:C2;
        [ | discriminate].
      destruct (cover n h depth the_setting (lam n q) (unit_U n q) (2 * k) (S (2 * i)) (2 * j)) eqn:C3;
        [ | discriminate].
      assert (K2 : (0 < 2 * k)%nat) by lia.
      destruct (edge_halves _ _ k i _ Hk Ha) as [A | A]; destruct (edge_halves _ _ k j _ Hk Hb) as [B | B].
      * exact (IH _ _ _ K2 HW C1 a b A B).
      * exact (IH _ _ _ K2 HW C2 a b A B).
      * exact (IH _ _ _ K2 HW C3 a b A B).
      * exact (IH _ _ _ K2 HW H a b A B).
Qed.

Lemma box_known : forall a b, within (box_x (the_claims n)) a -> within (box_v (the_claims n)) b ->
  hits_known f l r a b (value (fst (d_box h))) (value (snd (d_box h)))
    (phi_low (kind_ h)) (phi_high (kind_ h)).
Proof.
  assert (Hl := lambda_pos n ok). assert (HU := U_pos n ok). assert (H := tested).
  unfold box_tests in H. cbv zeta in H. cbn [forallb snd] in H. rewrite !andb_true_iff in H.
  destruct H as [HW [_ [HC _]]]. intros a b Ha Hb.
  simpl in Ha, Hb. apply within_shrunk in Ha; [ | exact Hl]. apply within_shrunk in Hb; [ | exact HU].
  change (lambda * CheckedUnits.w n * b) with (U * b) in Hb.
  apply (cover_ok (depth h) 1 0 0 ltac:(lia) HW HC a b).
  - destruct Ha as [A1 A2]. simpl in A1, A2. unfold edge, Rdiv. simpl. rewrite Rinv_1. lra.
  - destruct Hb as [A1 A2]. simpl in A1, A2. unfold edge, Rdiv. simpl. rewrite Rinv_1. lra.
Qed.

Lemma friction_known : kind_ h = Asymmetric -> exists s, forall d, value (fst (d_box h)) <= d <= value (snd (d_box h)) ->
  d <> 0 /\ r - l < G d /\ 0 < s * friction' l r d.
Proof.
  intros K. assert (H := tested). unfold box_tests, alone_ok in H. rewrite K in H.
  cbv zeta in H. cbn [forallb snd] in H. rewrite !andb_true_iff in H.
  destruct H as [_ [H _]]. set (a := value (fst (d_box h))) in *. set (b := value (snd (d_box h))) in *.
  assert (Main : forall d, a <= d <= b -> r - l < G d /\
    ((0 < d /\ friction' l r d < 0) \/ (d < 0 /\ 0 < friction' l r d))).
  { intros d Hd. destruct (edges_cover a b _ d (Pos2Nat.is_pos (pieces h)) Hd) as [i [Hi E]].
    assert (M := all_below_ok _ _ i H Hi). cbv beta in M.
    assert (In := part_ok q (d_box h) _ i d E). set (D := part q (d_box h) (Pos.to_nat (pieces h)) i) in *.
    unfold monotone_ok in M. rewrite !andb_true_iff, orb_true_iff in M. destruct M as [[S1 S2] S3].
    apply is_pos_ok with (1 := inn_sub q _ _ _ _ (inn_G q d _ In) (inn_rho n q)) in S2.
    assert (Fr := inn_friction' q l r d _ _ (inn_rho n q) In).
    split. lra. destruct (is_pos D) eqn:E1.
    - left. apply is_pos_ok with (1 := In) in E1. apply is_neg_ok with (1 := Fr) in S3. auto.
    - right. destruct S1 as [S1 | S1]. discriminate.
      apply is_neg_ok with (1 := In) in S1. apply is_pos_ok with (1 := Fr) in S3. auto. }
  destruct (Rlt_dec 0 a) as [L | L].
  - exists (-1). intros d Hd. destruct (Main d Hd) as [A [[B C] | [B C]]]; [ | lra].
    split. lra. split. exact A. lra.
  - exists 1. intros d Hd. destruct (Main d Hd) as [A [[B C] | [B C]]].
    + exfalso. destruct (Main 0 ltac:(lra)) as [_ [[Z _] | [Z _]]]; lra.
    + split. lra. split. exact A. lra.
Qed.

Lemma symmetric_alone : forall plus : bool,
  kind_ h = (if plus then Symmetric_plus else Symmetric_minus) -> forall d,
  value (fst (d_box h)) <= d <= value (snd (d_box h)) -> d <> 0 ->
  impossible f l r (if plus then 1 else -1) d.
Proof.
  intros plus K d Hd N. assert (H := tested). unfold box_tests in H. cbv zeta in H.
  cbn [forallb snd] in H. rewrite !andb_true_iff in H. destruct H as [_ [H _]].
  destruct (edges_cover _ _ _ d (Pos2Nat.is_pos (pieces h)) Hd) as [i [Hi E]].
  assert (M := all_below_ok _ _ i H Hi). unfold alone_ok in M.
  assert (In := part_ok q (d_box h) _ i d E).
  apply (impossible_ok q f l r d _ _ _ plus (inn_rho n q) (inn_f n q) In N).
  destruct plus; rewrite K in M; exact M.
Qed.

Lemma one_in_the_box : one_orbit f l r (value (fst (d_box h))) (value (snd (d_box h)))
  (phi_low (kind_ h)) (phi_high (kind_ h)).
Proof.
  assert (W := walls n ok). assert (P := PI_RGT_0). destruct (kind_ h) eqn:K.
  - destruct (friction_known K) as [s Fk]. apply (one_asymmetric f l r W _ _ s).
    intros d Hd. destruct (Fk d Hd) as (A & B & _). auto. intros d Hd. apply (Fk d Hd).
  - apply (one_symmetric f l r W _ _ _ _ 1); auto.
    intros phi H. cbn in H. lra. exact (symmetric_alone true K).
  - apply (one_symmetric f l r W _ _ _ _ (-1)); auto.
    intros phi H. cbn in H. lra. exact (symmetric_alone false K).
Qed.

End Box.
