(** * The tests of the orbit say what is claimed of its hits, speeds and state *)

From Coq Require Import Reals Lra Lia ZArith Bool List.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Flight Jet Stages OneOne Asymmetric Symmetric Dip Orbit Numbers Units
  Enclosure Data EvalOrbit EvalBox Check CheckedUnits.
Open Scope R_scope.

Section Orbit.

Variables (n : orbit_data) (h : hints).
Variables (o : shape) (s : around I.type).
Hypothesis tested : forallb snd (orbit_tests n h o s) = true.

Notation p := (Enclosure.F.PtoP (bits h)).
Notation f := (f n).
Notation l := (l n).
Notation r := (r n).
Notation U := (U n).
Notation lambda := (lambda n).

Ltac take H := assert (H := tested); unfold orbit_tests in H; cbv zeta in H; cbn [forallb snd] in H;
  rewrite !andb_true_iff in H.

Lemma parameters_ok : good n.
Proof.
  take H. destruct H as [[[[[H1 H2] H3] H4] H5] _].
  apply is_pos_ok with (1 := inn_num p (F_ n)) in H1. apply is_pos_ok with (1 := inn_num p (w_ n)) in H2.
  apply is_pos_ok with (1 := inn_f n p) in H3.
  apply is_pos_ok with (1 := inn_sub p _ _ _ _ (inn_Z p 1) (inn_f n p)) in H4.
  apply is_pos_ok with (1 := inn_rho n p) in H5. split; try assumption; lra.
Qed.

(** ** The orbit *)

Lemma asymmetric_exists : asymmetric_ok n h = true ->
  exists d, d <> 0 /\ r - l < G d /\ friction l r d = f /\ inn d (bracket h).
Proof.
  assert (W := walls n parameters_ok). intros H.
  unfold asymmetric_ok in H. cbv zeta in H. rewrite !andb_true_iff, !orb_true_iff, !andb_true_iff in H.
  destruct H as [[[H0 H1] H2] H3].
  assert (N0 := inn_num p (fst (d_ h))). assert (N1 := inn_num p (snd (d_ h))).
  set (d0 := value (fst (d_ h))) in *. set (d1 := value (snd (d_ h))) in *.
  apply is_pos_ok with (1 := inn_sub p _ _ _ _ N1 N0) in H0.
  assert (In : forall d, d0 <= d <= d1 -> inn d (bracket h)).
  { intros d Hd. apply (inn_between d0 d d1); assumption. }
  assert (Reg : forall d, d0 <= d <= d1 -> d <> 0 /\ r - l < G d).
  { intros d Hd. specialize (In d Hd). split.
    - destruct H1 as [H1 | H1]. apply is_pos_ok with (1 := In) in H1. lra.
      apply is_neg_ok with (1 := In) in H1. lra.
    - apply is_pos_ok with (1 := inn_sub p _ _ _ _ (inn_G p d _ In) (inn_rho n p)) in H2. lra. }
  assert (K0 := inn_sub p _ _ _ _ (inn_friction p l r d0 _ _ (inn_rho n p) N0) (inn_f n p)).
  assert (K1 := inn_sub p _ _ _ _ (inn_friction p l r d1 _ _ (inn_rho n p) N1) (inn_f n p)).
  assert (Ex : exists d, d0 <= d <= d1 /\ friction l r d = f).
  { destruct H3 as [[S0 S1] | [S0 S1]].
    - apply is_neg_ok with (1 := K0) in S0. apply is_pos_ok with (1 := K1) in S1.
      apply (parameter_exists f l r W d0 d1 Reg 1); lra.
    - apply is_pos_ok with (1 := K0) in S0. apply is_neg_ok with (1 := K1) in S1.
      apply (parameter_exists f l r W d0 d1 Reg (-1)); lra. }
  destruct Ex as (d & Hd & E). destruct (Reg d Hd) as [A B]. exists d. auto.
Qed.

Lemma orbit_exists : exists d S C W phi, closed f l r d S C W phi /\ fits d S C W phi (the_shape n h).
Proof.
  assert (W := walls n parameters_ok). assert (Hr := inn_rho n p). assert (Hf := inn_f n p).
  assert (F := f_small n parameters_ok). take H. destruct H as [_ [H _]].
  unfold bracket_ok in H. unfold the_shape. destruct (kind_ h).
  - destruct (asymmetric_exists H) as (d & N & Big & Fr & Dd).
    exists d, (S_of l r d), (C_of l r d), (W_of l r d), (phi_of l r d). split.
    exact (asymmetric f l r W d N Big Fr). exact (inn_asymmetric p l r d _ _ Hr Dd).
  - assert (HC : inn (C_sym f) (eval_C_sym p (scaled_f n p))) by (unfold C_sym, eval_C_sym; inn_auto).
    is_positive H (1 - C_sym f).
    exists 0, (S_sym f 1), (C_sym f), (W_sym f l r 1), (phi_sym f 1). split.
    apply symmetric; lra. exact (inn_symmetric p f l r _ _ 1 Hr Hf).
  - assert (HC : inn (C_sym f) (eval_C_sym p (scaled_f n p))) by (unfold C_sym, eval_C_sym; inn_auto).
    is_positive H (1 - C_sym f).
    exists 0, (S_sym f (-1)), (C_sym f), (W_sym f l r (-1)), (phi_sym f (-1)). split.
    apply symmetric; lra. exact (inn_symmetric p f l r _ _ (-1) Hr Hf).
Qed.

(** ** Hits and speeds *)

Variables t1 t2 u1 u2 x0 v0 : R.
Hypothesis in_t1 : inn t1 (e_t1 s).
Hypothesis in_sin1 : inn (sin t1) (e_sin1 s).
Hypothesis in_cos1 : inn (cos t1) (e_cos1 s).
Hypothesis in_t2 : inn t2 (e_t2 s).
Hypothesis in_sin2 : inn (sin t2) (e_sin2 s).
Hypothesis in_cos2 : inn (cos t2) (e_cos2 s).
Hypothesis in_u1 : inn u1 (eval_u1 p (scaled_f n p) o).
Hypothesis in_u2 : inn u2 (eval_u2 p (scaled_f n p) o).
Hypothesis in_x : inn x0 (e_x s).
Hypothesis in_v : inn v0 (e_v s).
Hypothesis orbit : closes f l r t1 t2 u1 u2.

Lemma order_ok : 0 < t1 /\ t1 < t2 /\ PI / 2 < t2 /\ t2 < 2 * PI /\ t2 < t1 + 2 * PI /\ t1 < PI.
Proof.
  take H. destruct H as [_ [_ [[[[[[O1 O2] O3] O4] O5] O6] _]]]. assert (Pi := inn_PI p).
  is_positive O1 t1. is_positive O2 (t2 - t1). is_positive O3 (t2 - PI / 2). is_positive O4 (2 * PI - t2).
  is_positive O5 (t1 + 2 * PI - t2). is_positive O6 (PI - t1). lra.
Qed.

Lemma in_low_back : inn (back_speed f t1 u1 (back_lowest f t1 t2))
  (nth 2 (speeds_of h (scaled_f n p) (eval_u1 p (scaled_f n p) o) (eval_u2 p (scaled_f n p) o) s) I.nai).
Proof.
  assert (Ord := order_ok). destruct (inn_turn p f _ (f_small n parameters_ok) (inn_f n p)) as [It Is].
  assert (Pi := inn_PI p). assert (If := inn_f n p).
  unfold back_lowest. cbn [speeds_of nth]. apply (inn_at_lowest p (back_speed f t1 u1)); auto.
  - lra.
  - inn_auto.
  - replace (back_speed f t1 u1 (PI - turn f)) with (u1 - sin (turn f) + sin t1 - f * (PI - turn f - t1))
      by (unfold back_speed, vel; rewrite sin_minus, sin_PI, cos_PI; ring). inn_auto.
  - unfold back_speed. rewrite vel_start, Ropp_involutive. exact in_u1.
  - unfold back_speed. rewrite (l_speed _ _ _ _ _ _ _ orbit), Ropp_involutive. exact in_u2.
Qed.

Lemma in_low_forth : inn (forth_speed f t2 u2 (forth_lowest f t1 t2))
  (nth 3 (speeds_of h (scaled_f n p) (eval_u1 p (scaled_f n p) o) (eval_u2 p (scaled_f n p) o) s) I.nai).
Proof.
  assert (Ord := order_ok). destruct (inn_turn p f _ (f_small n parameters_ok) (inn_f n p)) as [It Is].
  assert (Pi := inn_PI p). assert (If := inn_f n p).
  unfold forth_lowest. cbn [speeds_of nth]. apply (inn_at_lowest p (forth_speed f t2 u2)); auto.
  - lra.
  - inn_auto.
  - inn_auto.
  - replace (forth_speed f t2 u2 (2 * PI - turn f))
      with (u2 - sin (turn f) - sin t2 - f * (2 * PI - turn f - t2))
      by (unfold forth_speed, vel; rewrite sin_minus, sin_2PI, cos_2PI; ring). inn_auto.
  - unfold forth_speed. rewrite vel_start. exact in_u2.
  - unfold forth_speed. rewrite (r_speed _ _ _ _ _ _ _ orbit). exact in_u1.
Qed.

Lemma least_ok : 0 < value (fst (least_speed_ n)) / U /\
  (forall u, In u (low_speeds f t1 t2 u1 u2) -> value (fst (least_speed_ n)) / U <= u) /\
  (exists u, In u (low_speeds f t1 t2 u1 u2) /\ u <= value (snd (least_speed_ n)) / U).
Proof.
  assert (HU := U_pos n parameters_ok). assert (InU := inn_U n p).
  assert (Low3 := in_low_back). assert (Low4 := in_low_forth).
  take H. destruct H as [_ [_ [_ [[[Mv Sl] Fa] _]]]].
  cbn [speeds_of nth] in Low3, Low4. cbn [speeds_of forallb existsb] in Sl, Fa.
  rewrite !andb_true_iff in Sl. rewrite !orb_true_iff in Fa.
  destruct Sl as (Sl1 & Sl2 & Sl3 & Sl4 & _).
  assert (IL := inn_num p (fst (least_speed_ n))). assert (IH := inn_num p (snd (least_speed_ n))).
  apply is_pos_ok with (1 := IL) in Mv.
  assert (Above : forall u V, inn u V ->
    is_nonneg (I.sub p (I.mul p (unit_U n p) V) (num p (fst (least_speed_ n)))) = true ->
    value (fst (least_speed_ n)) / U <= u).
  { intros u V Hu H. is_nonnegative H (U * u - value (fst (least_speed_ n))).
    apply Rmult_le_reg_r with U. exact HU. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  assert (Below : forall u V, inn u V ->
    is_nonneg (I.sub p (num p (snd (least_speed_ n))) (I.mul p (unit_U n p) V)) = true ->
    u <= value (snd (least_speed_ n)) / U).
  { intros u V Hu H. is_nonnegative H (value (snd (least_speed_ n)) - U * u).
    apply Rmult_le_reg_r with U. exact HU. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  unfold low_speeds. split. apply Rdiv_lt_0_compat; assumption. split.
  - intros u [<- | [<- | [<- | [<- | []]]]].
    apply (Above _ _ in_u1 Sl1). apply (Above _ _ in_u2 Sl2).
    apply (Above _ _ Low3 Sl3). apply (Above _ _ Low4 Sl4).
  - destruct Fa as [Fa | [Fa | [Fa | [Fa | Fa]]]]; [ | | | | discriminate].
    + exists u1. split. simpl. auto. apply (Below _ _ in_u1 Fa).
    + exists u2. split. simpl. auto. apply (Below _ _ in_u2 Fa).
    + eexists. split. 2: apply (Below _ _ Low3 Fa). simpl. auto.
    + eexists. split. 2: apply (Below _ _ Low4 Fa). simpl. auto.
Qed.

Record orbit_claims_hold : Prop := {
  k_hit_1 : within (hit_1 (the_claims n)) t1;
  k_hit_2 : within (hit_2 (the_claims n)) t2;
  k_speed_1 : within (speed_1 (the_claims n)) u1;
  k_speed_2 : within (speed_2 (the_claims n)) u2;
  k_forcing_1 : within (forcing_1 (the_claims n)) (Rabs (cos t1) - f);
  k_forcing_2 : within (forcing_2 (the_claims n)) (Rabs (cos t2) - f);
  k_x : within (box_x (the_claims n)) x0;
  k_v : within (box_v (the_claims n)) v0 }.

Lemma claims_ok : orbit_claims_hold.
Proof.
  assert (Hl := lambda_pos n parameters_ok). assert (HU := U_pos n parameters_ok).
  assert (Hw := w_pos n parameters_ok). assert (Inw := inn_num p (w_ n)).
  assert (Wi : 0 < / w n) by (apply Rinv_0_lt_compat; exact Hw).
  assert (Uw : 0 < U * w n) by (apply Rmult_lt_0_compat; assumption).
  assert (InU := inn_U n p). assert (InL := inn_lam n p). assert (If := inn_f n p).
  assert (IUw := inn_mul p _ _ _ _ InU Inw).
  take H. destruct H as (_ & _ & _ & _ & H1 & H2 & S1 & S2 & F1 & F2 & [B1 B2] & _).
  split.
  - exact (inside_ok p (/ w n) t1 _ _ _ Wi (inn_inv p _ _ Inw) in_t1 H1).
  - exact (inside_ok p (/ w n) t2 _ _ _ Wi (inn_inv p _ _ Inw) in_t2 H2).
  - exact (inside_ok p U u1 _ _ _ HU InU in_u1 S1).
  - exact (inside_ok p U u2 _ _ _ HU InU in_u2 S2).
  - exact (inside_ok p (U * w n) _ _ _ _ Uw IUw (inn_sub p _ _ _ _ (inn_abs _ _ in_cos1) If) F1).
  - exact (inside_ok p (U * w n) _ _ _ _ Uw IUw (inn_sub p _ _ _ _ (inn_abs _ _ in_cos2) If) F2).
  - exact (inside_ok p lambda _ _ _ _ Hl InL in_x B1).
  - exact (inside_ok p U _ _ _ _ HU InU in_v B2).
Qed.

End Orbit.
