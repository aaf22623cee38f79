(** * The map of the period in other units

    X'(a, b) = lambda X(a/lambda, b/U), V'(a, b) = U V(a/lambda, b/U): smooth and area-preserving as
    (X, V) is, with the coefficients of its polynomials scaled, and with the twist tau/(lambda U),
    since dx dv has been multiplied by lambda U. *)

From Coq Require Import Reals Lra Lia ZArith.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Plane Smooth Order Jet NormalForm.
Open Scope R_scope.

Section Map.

Variables lambda U : R.
Hypothesis lambda_pos : 0 < lambda.
Hypothesis U_pos : 0 < U.

Definition mapped (c : R) (X : R -> R -> R) (a b : R) : R := c * X (a / lambda) (b / U).

Lemma unscale : forall x y : R, lambda * x / lambda = x /\ U * y / U = y.
Proof. intros. split; field; lra. Qed.

(** ** Around a point *)

Lemma near_scaled : forall (P : R -> R -> Prop) x v, locally_2d P x v ->
  locally_2d (fun a b => P (a / lambda) (b / U)) (lambda * x) (U * v).
Proof.
  intros P x v [d H]. assert (D : 0 < Rmin (d * lambda) (d * U)).
  { assert (Q := cond_pos d). apply Rmin_glb_lt; nra. }
  exists (mkposreal _ D). simpl. intros a b Ha Hb.
  assert (L1 := Rmin_l (d * lambda) (d * U)). assert (L2 := Rmin_r (d * lambda) (d * U)).
  apply H.
  - replace (a / lambda - x) with ((a - lambda * x) / lambda) by (field; lra).
    unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ lambda)) by (left; apply Rinv_0_lt_compat; lra).
    apply Rmult_lt_reg_r with lambda. lra. rewrite Rmult_assoc, Rinv_l by lra. lra.
  - replace (b / U - v) with ((b - U * v) / U) by (field; lra).
    unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ U)) by (left; apply Rinv_0_lt_compat; lra).
    apply Rmult_lt_reg_r with U. lra. rewrite Rmult_assoc, Rinv_l by lra. lra.
Qed.

Lemma smooth_scaled : forall c X x v, smooth X x v -> smooth (mapped c X) (lambda * x) (U * v).
Proof.
  intros c X x v S. apply (locally_2d_map _ _ _ _ (near_scaled _ _ _ S)). intros y z C n.
  apply cont_diff_scal, (cont_diff_comp n X (fun a _ => a / lambda) (fun _ b => b / U)).
  - apply C.
  - apply cont_diff_ext with (fun a _ => / lambda * a).
    apply locally_2d_forall. intros. unfold Rdiv. ring. apply cont_diff_scal, cont_diff_fst.
  - apply cont_diff_ext with (fun _ b => / U * b).
    apply locally_2d_forall. intros. unfold Rdiv. ring. apply cont_diff_scal, cont_diff_snd.
Qed.

Lemma D2_scaled : forall c X a b p q, D2 X (a / lambda) (b / U) p q ->
  D2 (mapped c X) a b (c * (p / lambda)) (c * (q / U)).
Proof.
  intros c X a b p q H.
  eapply D2_ext. eapply (D2_mult (fun _ _ => c) (fun a b => X (a / lambda) (b / U))).
  apply D2_const.
  apply (differentiable_pt_lim_comp X (fun a _ => a / lambda) (fun _ b => b / U)). exact H.
  eapply D2_ext. apply (D2_mult (fun a _ => a) (fun _ _ => / lambda) a b). apply D2_fst. apply D2_const.
  reflexivity. reflexivity. reflexivity.
  eapply D2_ext. apply (D2_mult (fun _ b => b) (fun _ _ => / U) a b). apply D2_snd. apply D2_const.
  reflexivity. reflexivity. reflexivity.
  reflexivity. simpl. unfold Rdiv. ring. simpl. unfold Rdiv. ring.
Qed.

Lemma area_scaled : forall X V x v, preserves_area X V x v ->
  preserves_area (mapped lambda X) (mapped U V) (lambda * x) (U * v).
Proof.
  intros X V x v H. apply (locally_2d_map _ _ _ _ (near_scaled _ _ _ H)).
  intros a b (A & B & C & D & DX & DV & E).
  exists (lambda * (A / lambda)), (lambda * (B / U)), (U * (C / lambda)), (U * (D / U)).
  split. apply D2_scaled, DX. split. apply D2_scaled, DV.
  rewrite <- E. field. split; lra.
Qed.

(** ** Polynomials *)

Definition jet_scaled (c p q : R) (j : jet R) : jet R :=
  Jet (c * c00 j) (c * p * c10 j) (c * q * c01 j)
      (c * (p * p) * c20 j) (c * (p * q) * c11 j) (c * (q * q) * c02 j)
      (c * (p * p * p) * c30 j) (c * (p * p * q) * c21 j) (c * (p * q * q) * c12 j)
      (c * (q * q * q) * c03 j).

Lemma ev_scaled : forall c p q j a b, ev (jet_scaled c p q j) a b = c * ev j (p * a) (q * b).
Proof. intros. unfold jet_scaled, ev. simpl. ring. Qed.

Lemma order_scaled : forall n p q f, order n f -> order n (fun a b => f (p * a) (q * b)).
Proof.
  intros n p q f H. apply (order_comp n f (fun a _ => p * a) (fun _ b => q * b)). exact H.
  apply order_scal, order_a. apply order_scal, order_b.
Qed.

Lemma expands_scaled : forall c X x v j, expands X x v j ->
  expands (mapped c X) (lambda * x) (U * v) (jet_scaled c (/ lambda) (/ U) j).
Proof.
  intros c X x v j H. unfold expands in *.
  apply order_ext with (2 := order_scal 4 c _ (order_scaled 4 (/ lambda) (/ U) _ H)).
  intros a b. rewrite ev_scaled. unfold mapped.
  replace ((lambda * x + a) / lambda) with (x + / lambda * a) by (field; lra).
  replace ((U * v + b) / U) with (v + / U * b) by (field; lra). ring.
Qed.

(** ** The normal form *)

Lemma normal_form_ext : forall X V X' V' x v Theta tau,
  (forall a b, X a b = X' a b) -> (forall a b, V a b = V' a b) ->
  normal_form X V x v Theta tau -> normal_form X' V' x v Theta tau.
Proof.
  intros X V X' V' x v Theta tau EX EV (h & k & h0 & k0 & Det & Hx & Hv).
  exists h, k. split. exact h0. split. exact k0. split. exact Det. split.
  - apply order_ext with (2 := Hx). intros. simpl. rewrite EX. reflexivity.
  - apply order_ext with (2 := Hv). intros. simpl. rewrite EV. reflexivity.
Qed.

Lemma normal_form_scaled : forall X V x v Theta tau, normal_form X V x v Theta tau ->
  normal_form (mapped lambda X) (mapped U V) (lambda * x) (U * v) Theta (tau / (lambda * U)).
Proof.
  intros X V x v Theta tau (h & k & h0 & k0 & Det & Hx & Hv).
  assert (P : 0 < / (lambda * U)) by (apply Rinv_0_lt_compat; nra).
  set (s := sqrt (/ (lambda * U))). assert (Es : s * s = / (lambda * U)) by (apply sqrt_sqrt; lra).
  exists (jet_scaled lambda s s h), (jet_scaled U s s k).
  split. simpl. rewrite h0. ring. split. simpl. rewrite k0. ring.
  split.
  { simpl. transitivity ((lambda * U) * (s * s) * (c10 h * c01 k - c01 h * c10 k)). ring.
    rewrite Es, Det. field. split; lra. }
  assert (Angle : forall a b, Theta + tau / (lambda * U) * (a * a + b * b) =
    Theta + tau * ((s * a) * (s * a) + (s * b) * (s * b))).
  { intros a b. transitivity (Theta + tau * ((s * s) * (a * a + b * b))). rewrite Es. field. split; lra.
    ring. }
  split; [ apply order_ext with (2 := order_scal 4 lambda _ (order_scaled 4 s s _ Hx))
         | apply order_ext with (2 := order_scal 4 U _ (order_scaled 4 s s _ Hv)) ];
    intros a b; cbv zeta beta; rewrite !ev_scaled, Angle; unfold mapped;
    set (g := Theta + tau * (s * a * (s * a) + s * b * (s * b)));
    replace ((lambda * x + lambda * ev h (s * a) (s * b)) / lambda) with (x + ev h (s * a) (s * b))
      by (field; lra);
    replace ((U * v + U * ev k (s * a) (s * b)) / U) with (v + ev k (s * a) (s * b)) by (field; lra);
    replace (s * (cos g * a - sin g * b)) with (cos g * (s * a) - sin g * (s * b)) by ring;
    replace (s * (sin g * a + cos g * b)) with (sin g * (s * a) + cos g * (s * b)) by ring; ring.
Qed.

End Map.

(** Only one twist, too. *)

Lemma twist_scaled : forall lambda U X V x v Theta tau, 0 < lambda -> 0 < U ->
  (forall tau', normal_form X V x v Theta tau' -> tau' = tau) ->
  forall tau', normal_form (mapped lambda U lambda X) (mapped lambda U U V) (lambda * x) (U * v) Theta tau' ->
  tau' = tau / (lambda * U).
Proof.
  intros lambda U X V x v Theta tau Hl Hu Only tau' N.
  assert (Li : 0 < / lambda) by (apply Rinv_0_lt_compat; assumption).
  assert (Ui : 0 < / U) by (apply Rinv_0_lt_compat; assumption).
  assert (B := normal_form_scaled (/ lambda) (/ U) Li Ui _ _ _ _ _ _ N).
  replace (/ lambda * (lambda * x)) with x in B by (field; lra).
  replace (/ U * (U * v)) with v in B by (field; lra).
  assert (E : tau' / (/ lambda * / U) = tau).
  { apply Only. apply normal_form_ext with (3 := B); intros a b; unfold mapped.
    - replace (a / / lambda / lambda) with a by (field; lra).
      replace (b / / U / U) with b by (field; lra). field. lra.
    - replace (a / / lambda / lambda) with a by (field; lra).
      replace (b / / U / U) with b by (field; lra). field. lra. }
  rewrite <- E. field. split; lra.
Qed.
