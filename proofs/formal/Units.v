(** * The theorems in any units from the theorems in units F = w = 1 *)

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

Definition orbit_in_units (c : orbit_claims) : orbit_claims := {|
  box_x := shrunk lambda (box_x c); box_v := shrunk U (box_v c); least_speed := shrunk U (least_speed c);
  hit_1 := shrunk (/ mu) (hit_1 c); hit_2 := shrunk (/ mu) (hit_2 c);
  speed_1 := shrunk U (speed_1 c); speed_2 := shrunk U (speed_2 c);
  forcing_1 := shrunk (U * mu) (forcing_1 c); forcing_2 := shrunk (U * mu) (forcing_2 c);
  trace := trace c |}.

Definition elliptic_in_units (c : elliptic_claims) : elliptic_claims := {|
  of_orbit := orbit_in_units c;
  taylor_x := jet_shrunk lambda (/ lambda) (/ U) (taylor_x c);
  taylor_v := jet_shrunk U (/ lambda) (/ U) (taylor_v c);
  angle := angle c; rotation := rotation c; twist := shrunk (/ (lambda * U)) (twist c) |}.

Definition saddle_in_units (c : saddle_claims) : saddle_claims := {|
  of_saddle := orbit_in_units c; state_x := shrunk lambda (state_x c); state_v := shrunk U (state_v c);
  x_x := x_x c; x_v := shrunk (/ mu) (x_v c); v_x := shrunk mu (v_x c); v_v := v_v c;
  outer := outer c; inner := inner c |}.

Lemma U_pos' : 0 < U.
Proof. apply Rmult_lt_0_compat; assumption. Qed.

Definition X_in_units (X : R -> R -> R) : R -> R -> R := mapped lambda U lambda X.
Definition V_in_units (V : R -> R -> R) : R -> R -> R := mapped lambda U U V.
Definition jx_in_units (j : jet R) : jet R := jet_scaled lambda (/ lambda) (/ U) j.
Definition jv_in_units (j : jet R) : jet R := jet_scaled U (/ lambda) (/ U) j.

(** What is more to be said of the map has to be scaled, too. *)

Definition scales (f l r : R) (more more' : (R -> R -> R) -> (R -> R -> R) -> R -> R -> jet R -> jet R -> Prop) :
  Prop := forall X V x v jx jv,
  let X' := X_in_units X in let V' := V_in_units V in let x' := lambda * x in let v' := U * v in
  locally_2d (fun a b => image (U * mu * 1) (mu * 1) (U * mu * f) (lambda * l) (lambda * r) 1
    a b (X' a b) (V' a b)) x' v' ->
  X' x' v' = x' -> V' x' v' = v' -> smooth X' x' v' -> smooth V' x' v' -> preserves_area X' V' x' v' ->
  more X V x v jx jv -> more' X' V' x' v' (jx_in_units jx) (jv_in_units jv).

Lemma trace_in_units : forall jx jv, c10 (jx_in_units jx) = c10 jx /\ c01 (jv_in_units jv) = c01 jv.
Proof. assert (P := U_pos'). intros. split; simpl; field; lra. Qed.

Theorem orbit_scaled : forall f l r c more more', scales f l r more more' ->
  orbit_with 1 1 f l r (orbit_in_units c) more ->
  orbit_with (U * mu * 1) (mu * 1) (U * mu * f) (lambda * l) (lambda * r) c more'.
Proof.
  intros f l r c more more' Sc (x & v & t1 & t2 & Laws & Per & Slow & Fast & Hits & H1 & H2 & S1 & S2 & F1 & F2
    & Box & Bx & Bv & X & V & jx & jv & Im & FX & FV & SX & SV & Area & EX & EV & Det & Tr & More).
  assert (P := U_pos'). assert (Im_pos : 0 < / mu) by (apply Rinv_0_lt_compat; assumption).
  assert (Um : 0 < U * mu) by (apply Rmult_lt_0_compat; assumption).
  assert (ET : mu * T (mu * 1) = T 1) by (unfold T; field; lra).
  simpl in H1, H2, S1, S2, F1, F2, Bx, Bv.
  rewrite within_shrunk in H1, H2, S1, S2, F1, F2, Bx, Bv by assumption.
  assert (Time : forall t s n, mu * t = s + IZR n * T 1 <-> t = / mu * s + IZR n * T (mu * 1)).
  { intros t s n. rewrite <- ET. split; intros E.
    apply Rmult_eq_reg_l with mu. rewrite E. field. lra. lra. rewrite E. field. lra. }
  assert (ImS : forall a b y z, image 1 1 f l r 1 a b y z ->
    image (U * mu * 1) (mu * 1) (U * mu * f) (lambda * l) (lambda * r) 1
      (lambda * a) (U * b) (lambda * y) (U * z)).
  { intros a b y z. apply (image_scaled lambda mu lambda_pos mu_pos 1 1 f l r 1). lra. }
  unfold orbit_with.
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
  set (X' := X_in_units X). set (V' := V_in_units V).
  assert (FX' : X' (lambda * x 0) (U * v 0) = lambda * x 0).
  { unfold X', X_in_units, mapped. destruct (unscale lambda U lambda_pos P (x 0) (v 0)) as [-> ->].
    rewrite FX. reflexivity. }
  assert (FV' : V' (lambda * x 0) (U * v 0) = U * v 0).
  { unfold V', V_in_units, mapped. destruct (unscale lambda U lambda_pos P (x 0) (v 0)) as [-> ->].
    rewrite FV. reflexivity. }
  assert (Im' : locally_2d (fun a b => image (U * mu * 1) (mu * 1) (U * mu * f) (lambda * l) (lambda * r) 1
    a b (X' a b) (V' a b)) (lambda * x 0) (U * v 0)).
  { destruct (near_scaled lambda U lambda_pos P _ _ _ Im) as [d Hd]. exists d. intros a b Ha Hb.
    assert (Q := ImS _ _ _ _ (Hd a b Ha Hb)).
    replace (lambda * (a / lambda)) with a in Q by (field; lra).
    replace (U * (b / U)) with b in Q by (field; lra). exact Q. }
  assert (SX' : smooth X' (lambda * x 0) (U * v 0)) by (apply smooth_scaled; assumption).
  assert (SV' : smooth V' (lambda * x 0) (U * v 0)) by (apply smooth_scaled; assumption).
  assert (Area' : preserves_area X' V' (lambda * x 0) (U * v 0)) by (apply area_scaled; assumption).
  destruct (trace_in_units jx jv) as [T1 T2].
  exists X', V', (jx_in_units jx), (jv_in_units jv).
  split. exact Im'. split. exact FX'. split. exact FV'. split. exact SX'. split. exact SV'.
  split. exact Area'.
  split. apply expands_scaled; assumption. split. apply expands_scaled; assumption.
  split. { rewrite T1, T2, <- Det. simpl. field. split; lra. }
  split. { rewrite T1, T2. exact Tr. }
  apply Sc; assumption.
Qed.

Theorem elliptic_scales : forall f l r c, scales f l r (elliptic 1 1 f l r (elliptic_in_units c))
  (elliptic (U * mu * 1) (mu * 1) (U * mu * f) (lambda * l) (lambda * r) c).
Proof.
  intros f l r c X V x v jx jv X' V' x' v' Im' FX' FV' SX' SV' Area'
    (Jx & Jv & Theta & tau & Cos & Bd & An & Ro & NR & NF & Tw & Tn & Only & _).
  assert (P := U_pos'). assert (Li : 0 < / lambda) by (apply Rinv_0_lt_compat; assumption).
  assert (Ui : 0 < / U) by (apply Rinv_0_lt_compat; assumption).
  assert (LU : 0 < / (lambda * U)) by (apply Rinv_0_lt_compat, Rmult_lt_0_compat; assumption).
  simpl in Tw. rewrite within_shrunk in Tw by assumption.
  assert (NF' : normal_form X' V' x' v' Theta (tau / (lambda * U))) by (apply normal_form_scaled; assumption).
  assert (Tn' : tau / (lambda * U) <> 0).
  { unfold Rdiv. apply Rmult_integral_contrapositive_currified. exact Tn. lra. }
  destruct (trace_in_units jx jv) as [T1 T2].
  split. apply within_jet_shrunk; assumption. split. apply within_jet_shrunk; assumption.
  exists Theta, (tau / (lambda * U)). rewrite T1, T2.
  split. exact Cos. split. exact Bd. split. exact An. split. exact Ro.
  split. exact NR. split. exact NF'.
  split. { replace (tau / (lambda * U)) with (/ (lambda * U) * tau) by (unfold Rdiv; ring). exact Tw. }
  split. exact Tn'. split.
  { exact (twist_scaled lambda U X V _ _ Theta tau lambda_pos P Only). }
  exact (stable_if_Moser X' V' _ _ _ Im' Theta _ FX' FV' SX' SV' Area' NF' NR Tn').
Qed.

Theorem saddle_scales : forall f l r c, scales f l r (saddle (saddle_in_units c)) (saddle c).
Proof.
  intros f l r c X V x v jx jv X' V' x' v' _ _ _ _ _ _
    (Sx & Sv & A & B & C & D & m & Sum & Out & Mo & Mi).
  assert (P := U_pos'). assert (Im : 0 < / mu) by (apply Rinv_0_lt_compat; assumption).
  simpl in Sx, Sv, A, B, C, D, Mo, Mi. rewrite within_shrunk in Sx, Sv, B, C by assumption.
  destruct (trace_in_units jx jv) as [T1 T2].
  split. exact Sx. split. exact Sv. rewrite T1, T2. split. exact A.
  split. { replace (c01 (jx_in_units jx)) with (/ mu * c01 jx) by (simpl; unfold U; field; lra). exact B. }
  split. { replace (c10 (jv_in_units jv)) with (mu * c10 jv) by (simpl; unfold U; field; lra). exact C. }
  split. exact D. exists m. auto.
Qed.

End Units.
