(** * The theorem in any units from the theorem in units F = w = 1 *)

From Coq Require Import Reals Lra Lia ZArith.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Limits Scaling ScaledMap Moser.
Open Scope R_scope.

(** The interval that becomes [i] when it is multiplied by k > 0. *)

Definition shrunk (k : R) (i : interval) : interval := {| lo := lo i / k; hi := hi i / k |}.

Lemma within_shrunk : forall k i y, 0 < k -> within (shrunk k i) y <-> within i (k * y).
Proof.
  intros k i y H. unfold within, shrunk. simpl.
  assert (E : forall z, z / k * k = z) by (intros; field; lra). split; intros [A B]; split.
  - rewrite <- (E (lo i)). rewrite (Rmult_comm k). apply Rmult_le_compat_r; lra.
  - rewrite <- (E (hi i)). rewrite (Rmult_comm k). apply Rmult_le_compat_r; lra.
  - apply Rmult_le_reg_r with k. exact H. rewrite E. lra.
  - apply Rmult_le_reg_r with k. exact H. rewrite E. lra.
Qed.

Definition jet_shrunk (c p q : R) (j : jet interval) : jet interval :=
  Jet (shrunk c (c00 j)) (shrunk (c * p) (c10 j)) (shrunk (c * q) (c01 j))
      (shrunk (c * (p * p)) (c20 j)) (shrunk (c * (p * q)) (c11 j)) (shrunk (c * (q * q)) (c02 j))
      (shrunk (c * (p * p * p)) (c30 j)) (shrunk (c * (p * p * q)) (c21 j))
      (shrunk (c * (p * q * q)) (c12 j)) (shrunk (c * (q * q * q)) (c03 j)).

Lemma within_jet_shrunk : forall c p q i j, 0 < c -> 0 < p -> 0 < q ->
  within_jet (jet_shrunk c p q i) j -> within_jet i (jet_scaled c p q j).
Proof.
  intros c p q i j Hc Hp Hq H. assert (P2 : 0 < p * p) by nra. assert (Pq : 0 < p * q) by nra.
  assert (Q2 : 0 < q * q) by nra. assert (P3 : 0 < p * p * p) by nra. assert (P2q : 0 < p * p * q) by nra.
  assert (Pq2 : 0 < p * q * q) by nra. assert (Q3 : 0 < q * q * q) by nra.
  unfold within_jet, jet_shrunk, jet_scaled in *. simpl in *.
  rewrite !within_shrunk in H by (try apply Rmult_lt_0_compat; assumption). exact H.
Qed.

Section Units.

Variables lambda mu : R.
Hypothesis lambda_pos : 0 < lambda.
Hypothesis mu_pos : 0 < mu.
Let U := lambda * mu.

(** The claims in units F = w = 1: lengths in units lambda, speeds in U, times in 1/mu. *)

Definition in_units (c : claims) : claims := {|
  box_x := shrunk lambda (box_x c); box_v := shrunk U (box_v c); least_speed := shrunk U (least_speed c);
  hit_1 := shrunk (/ mu) (hit_1 c); hit_2 := shrunk (/ mu) (hit_2 c);
  speed_1 := shrunk U (speed_1 c); speed_2 := shrunk U (speed_2 c);
  forcing_1 := shrunk (U * mu) (forcing_1 c); forcing_2 := shrunk (U * mu) (forcing_2 c);
  taylor_x := jet_shrunk lambda (/ lambda) (/ U) (taylor_x c);
  taylor_v := jet_shrunk U (/ lambda) (/ U) (taylor_v c);
  trace := trace c; angle := angle c; rotation := rotation c;
  twist := shrunk (/ (lambda * U)) (twist c) |}.

Lemma U_pos' : 0 < U.
Proof. apply Rmult_lt_0_compat; assumption. Qed.

Theorem elliptic_scaled : forall f l r c, elliptic_orbit 1 1 f l r (in_units c) ->
  elliptic_orbit (U * mu * 1) (mu * 1) (U * mu * f) (lambda * l) (lambda * r) c.
Proof.
  intros f l r c (x & v & t1 & t2 & Laws & Per & Slow & Fast & Hits & H1 & H2 & S1 & S2 & F1 & F2 & Box
    & Bx & Bv & X & V & jx & jv & Im & FX & FV & SX & SV & Area & EX & EV & Jx & Jv & Det & Tr
    & Theta & tau & Cos & Bd & An & Ro & NR & NF & Tw & Tn & Only & Mo).
  assert (P := U_pos'). assert (Im_pos : 0 < / mu) by (apply Rinv_0_lt_compat; assumption).
  assert (Um : 0 < U * mu) by (apply Rmult_lt_0_compat; assumption).
  assert (LU : 0 < / (lambda * U)) by (apply Rinv_0_lt_compat, Rmult_lt_0_compat; assumption).
  assert (ET : mu * T (mu * 1) = T 1) by (unfold T; field; lra).
  simpl in H1, H2, S1, S2, F1, F2, Bx, Bv, Tw.
  rewrite within_shrunk in H1, H2, S1, S2, F1, F2, Bx, Bv, Tw by assumption.
  assert (Time : forall t s n, mu * t = s + IZR n * T 1 <-> t = / mu * s + IZR n * T (mu * 1)).
  { intros t s n. rewrite <- ET. split; intros E.
    apply Rmult_eq_reg_l with mu. rewrite E. field. lra. lra. rewrite E. field. lra. }
  assert (ImS : forall a b y z, image 1 1 f l r 1 a b y z ->
    image (U * mu * 1) (mu * 1) (U * mu * f) (lambda * l) (lambda * r) 1
      (lambda * a) (U * b) (lambda * y) (U * z)).
  { intros a b y z. apply (image_scaled lambda mu lambda_pos mu_pos 1 1 f l r 1). lra. }
  unfold elliptic_orbit.
  exists (fun t => lambda * x (mu * t)), (fun t => U * v (mu * t)), (/ mu * t1), (/ mu * t2).
  split. { intros t. apply laws_scaled; auto. }
  split. { intros t. replace (mu * (t + T (mu * 1))) with (mu * t + T 1) by (rewrite <- ET; ring).
    destruct (Per (mu * t)) as [-> ->]. auto. }
  split. { intros t. specialize (Slow (mu * t)). simpl in Slow. rewrite Rabs_mult, (Rabs_pos_eq U) by lra.
    apply Rmult_le_reg_r with (/ U). apply Rinv_0_lt_compat, P.
    replace (U * Rabs (v (mu * t)) * / U) with (Rabs (v (mu * t))) by (field; lra). exact Slow. }
  split. { destruct Fast as [t Ht]. simpl in Ht. exists (/ mu * t).
    replace (mu * (/ mu * t)) with t by (field; lra). rewrite Rabs_mult, (Rabs_pos_eq U) by lra.
    apply Rmult_le_reg_r with (/ U). apply Rinv_0_lt_compat, P.
    replace (U * Rabs (v t) * / U) with (Rabs (v t)) by (field; lra). exact Ht. }
  split.
  { intros t. destruct (Hits (mu * t)) as [[A A'] [B B']]. split; split.
    - intros E. destruct A as [n En]. apply Rmult_eq_reg_l with lambda; lra.
      exists n. apply Time, En.
    - intros [n En]. rewrite A'. reflexivity. exists n. apply Time, En.
    - intros E. destruct B as [n En]. apply Rmult_eq_reg_l with lambda; lra.
      exists n. apply Time, En.
    - intros [n En]. rewrite B'. reflexivity. exists n. apply Time, En. }
  assert (M1 : forall t, mu * (/ mu * t) = t) by (intros; field; lra).
  assert (M2 : forall t, mu * 1 * (/ mu * t) = 1 * t) by (intros; field; lra).
  split. exact H1. split. exact H2.
  split. { rewrite M1. replace (- (U * v t1)) with (U * - v t1) by ring. exact S1. }
  split. { rewrite M1. exact S2. }
  assert (Fo : forall t, U * mu * (Rabs (1 * cos (1 * t)) - f) =
    Rabs (U * mu * 1 * cos (mu * 1 * (/ mu * t))) - U * mu * f).
  { intros t. rewrite M2. replace (U * mu * 1 * cos (1 * t)) with (U * mu * (1 * cos (1 * t))) by ring.
    rewrite (Rabs_mult (U * mu)), (Rabs_pos_eq (U * mu)) by lra. ring. }
  split. { rewrite <- Fo. exact F1. } split. { rewrite <- Fo. exact F2. }
  replace (mu * 0) with 0 by ring.
  split.
  { intros a b Ha Hb. specialize (Box (a / lambda) (b / U)). simpl in Box.
    destruct Box as [[y [z I]] Fixed].
    { apply within_shrunk. assumption. replace (lambda * (a / lambda)) with a by (field; lra). exact Ha. }
    { apply within_shrunk. assumption. replace (U * (b / U)) with b by (field; lra). exact Hb. }
    apply ImS in I. replace (lambda * (a / lambda)) with a in I by (field; lra).
    replace (U * (b / U)) with b in I by (field; lra).
    split. { eexists. eexists. exact I. }
    intros J. destruct Fixed as [Ea Eb].
    - assert (Li : 0 < / lambda) by (apply Rinv_0_lt_compat; assumption).
      assert (Back := image_scaled (/ lambda) (/ mu) Li Im_pos (U * mu * 1) (mu * 1) (U * mu * f)
        (lambda * l) (lambda * r) 1 ltac:(lra) _ _ _ _ J).
      replace (/ lambda * / mu * / mu * (U * mu * 1)) with 1 in Back by (unfold U; field; split; lra).
      replace (/ mu * (mu * 1)) with 1 in Back by (field; lra).
      replace (/ lambda * / mu * / mu * (U * mu * f)) with f in Back by (unfold U; field; split; lra).
      replace (/ lambda * (lambda * l)) with l in Back by (field; lra).
      replace (/ lambda * (lambda * r)) with r in Back by (field; lra).
      replace (/ lambda * a) with (a / lambda) in Back by (unfold Rdiv; ring).
      replace (/ lambda * / mu * b) with (b / U) in Back by (unfold U; field; split; lra). exact Back.
    - split. rewrite <- Ea. field. lra. rewrite <- Eb. field. lra. }
  split. exact Bx. split. exact Bv.
  assert (Li : 0 < / lambda) by (apply Rinv_0_lt_compat; assumption).
  assert (Ui : 0 < / U) by (apply Rinv_0_lt_compat; assumption).
  set (X' := mapped lambda U lambda X). set (V' := mapped lambda U U V).
  assert (FX' : X' (lambda * x 0) (U * v 0) = lambda * x 0).
  { unfold X', mapped. destruct (unscale lambda U lambda_pos P (x 0) (v 0)) as [-> ->]. rewrite FX. reflexivity. }
  assert (FV' : V' (lambda * x 0) (U * v 0) = U * v 0).
  { unfold V', mapped. destruct (unscale lambda U lambda_pos P (x 0) (v 0)) as [-> ->]. rewrite FV. reflexivity. }
  assert (Im' : locally_2d (fun a b => image (U * mu * 1) (mu * 1) (U * mu * f) (lambda * l) (lambda * r) 1
    a b (X' a b) (V' a b)) (lambda * x 0) (U * v 0)).
  { destruct (near_scaled lambda U lambda_pos P _ _ _ Im) as [d Hd]. exists d. intros a b Ha Hb.
    assert (Q := ImS _ _ _ _ (Hd a b Ha Hb)).
    replace (lambda * (a / lambda)) with a in Q by (field; lra).
    replace (U * (b / U)) with b in Q by (field; lra). exact Q. }
  assert (SX' := smooth_scaled lambda U lambda_pos P lambda X _ _ SX).
  assert (SV' := smooth_scaled lambda U lambda_pos P U V _ _ SV).
  assert (Area' := area_scaled lambda U lambda_pos P X V _ _ Area).
  assert (NF' := normal_form_scaled lambda U lambda_pos P X V _ _ _ _ NF).
  assert (Tn' : tau / (lambda * U) <> 0).
  { unfold Rdiv. apply Rmult_integral_contrapositive_currified. exact Tn. lra. }
  exists X', V', (jet_scaled lambda (/ lambda) (/ U) jx), (jet_scaled U (/ lambda) (/ U) jv).
  split. exact Im'. split. exact FX'. split. exact FV'. split. exact SX'. split. exact SV'.
  split. exact Area'.
  split. apply expands_scaled; assumption. split. apply expands_scaled; assumption.
  split. apply within_jet_shrunk; assumption. split. apply within_jet_shrunk; assumption.
  assert (T1 : c10 (jet_scaled lambda (/ lambda) (/ U) jx) = c10 jx) by (simpl; field; lra).
  assert (T2 : c01 (jet_scaled U (/ lambda) (/ U) jv) = c01 jv) by (simpl; field; lra).
  split. { rewrite T1, T2, <- Det. simpl. field. split; lra. }
  rewrite T1, T2. split. exact Tr.
  exists Theta, (tau / (lambda * U)). split. exact Cos. split. exact Bd. split. exact An. split. exact Ro.
  split. exact NR. split. exact NF'.
  split. { replace (tau / (lambda * U)) with (/ (lambda * U) * tau) by (unfold Rdiv; ring). exact Tw. }
  split. exact Tn'. split.
  { exact (twist_scaled lambda U X V _ _ Theta tau lambda_pos P Only). }
  exact (stable_if_Moser X' V' _ _ _ Im' Theta _ FX' FV' SX' SV' Area' NF' NR Tn').
Qed.

End Units.
