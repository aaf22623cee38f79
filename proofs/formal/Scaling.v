(** * Other units

    If x(t) is a motion for (F, w, f, l, r), then lambda x(mu t) is one for

      (lambda mu^2 F, mu w, lambda mu^2 f, lambda l, lambda r):

    so all that is said in units F = w = 1 is said of (F, w), with lambda = F/w^2 and mu = w. *)

From Coq Require Import Reals Lra Lia ZArith.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Limits.
Open Scope R_scope.

(** ** Limits *)

Section Limits.

Variables mu c : R.
Hypothesis mu_pos : 0 < mu.

Lemma scaled_left : forall (h : R -> R) t y, filterlim h (at_left (mu * t)) (locally y) ->
  filterlim (fun s => c * h (mu * s)) (at_left t) (locally (c * y)).
Proof.
  intros h t y H. apply (filterlim_comp _ _ _ (fun s => h (mu * s)) (fun z => c * z) _ (locally y)).
  - apply (filterlim_comp _ _ _ (fun s => mu * s) h _ (at_left (mu * t))). 2: exact H.
    intros P [d HP]. apply at_left_intro with (d / mu). apply Rdiv_lt_0_compat. apply cond_pos. exact mu_pos.
    intros s Hs. apply HP. 2: nra.
    change (Rabs (mu * s - mu * t) < d).
    replace (mu * s - mu * t) with (- (mu * (t - s))) by ring. rewrite Rabs_Ropp, Rabs_pos_eq by nra.
    apply Rmult_lt_reg_r with (/ mu). apply Rinv_0_lt_compat, mu_pos.
    replace (mu * (t - s) * / mu) with (t - s) by (field; lra). unfold Rdiv in Hs. lra.
  - apply (filterlim_scal_r (K := R_AbsRing) (V := R_NormedModule) c y).
Qed.

Lemma scaled_right : forall (h : R -> R) t y, filterlim h (at_right (mu * t)) (locally y) ->
  filterlim (fun s => c * h (mu * s)) (at_right t) (locally (c * y)).
Proof.
  intros h t y H. apply (filterlim_comp _ _ _ (fun s => h (mu * s)) (fun z => c * z) _ (locally y)).
  - apply (filterlim_comp _ _ _ (fun s => mu * s) h _ (at_right (mu * t))). 2: exact H.
    intros P [d HP]. apply at_right_intro with (d / mu). apply Rdiv_lt_0_compat. apply cond_pos. exact mu_pos.
    intros s Hs. apply HP. 2: nra.
    change (Rabs (mu * s - mu * t) < d).
    replace (mu * s - mu * t) with (mu * (s - t)) by ring. rewrite Rabs_pos_eq by nra.
    apply Rmult_lt_reg_r with (/ mu). apply Rinv_0_lt_compat, mu_pos.
    replace (mu * (s - t) * / mu) with (s - t) by (field; lra). unfold Rdiv in Hs. lra.
  - apply (filterlim_scal_r (K := R_AbsRing) (V := R_NormedModule) c y).
Qed.

Lemma scaled_continuous : forall (h : R -> R) t, continuous h (mu * t) ->
  continuous (fun s => c * h (mu * s)) t.
Proof.
  intros h t H. apply (continuous_scal_r (K := R_AbsRing) (V := R_NormedModule) c (fun s => h (mu * s))).
  apply (continuous_comp (fun s => mu * s) h). 2: exact H.
  apply (ex_derive_continuous (fun s => mu * s)). auto_derive. exact I.
Qed.

Lemma scaled_derive : forall (h : R -> R) t k, is_derive h (mu * t) k ->
  is_derive (fun s => c * h (mu * s)) t (c * mu * k).
Proof.
  intros h t k H. evar_last. apply (is_derive_scal (fun s => h (mu * s)) t c).
  apply (is_derive_comp h (fun s => mu * s)). exact H. auto_derive. exact I. reflexivity.
  unfold scal; simpl; unfold mult; simpl. ring.
Qed.

End Limits.

(** ** Motions *)

Section Motions.

Variables lambda mu : R.
Hypothesis lambda_pos : 0 < lambda.
Hypothesis mu_pos : 0 < mu.
Variables F w f l r e : R.
Let U := lambda * mu.

Notation laws := (laws F w f l r e).
Notation laws' := (Statement.laws (U * mu * F) (mu * w) (U * mu * f) (lambda * l) (lambda * r) e).
Notation motion := (motion F w f l r e).
Notation motion' := (Statement.motion (U * mu * F) (mu * w) (U * mu * f) (lambda * l) (lambda * r) e).
Notation scaled_x x := (fun t => lambda * x (mu * t)).
Notation scaled_v v := (fun t => U * v (mu * t)).

Lemma U_pos : 0 < U.
Proof. apply Rmult_lt_0_compat; assumption. Qed.

Lemma sign_scaled : forall y, sign (U * y) = sign y.
Proof.
  intros y. assert (P := U_pos). destruct (Rtotal_order y 0) as [L | [-> | G]].
  - rewrite !sign_eq_m1; auto. nra.
  - rewrite Rmult_0_r. reflexivity.
  - rewrite !sign_eq_1; auto. nra.
Qed.

Lemma laws_scaled : forall x v t, laws x v (mu * t) -> laws' (scaled_x x) (scaled_v v) t.
Proof.
  intros x v t (In & Free & Right & Left). assert (P := U_pos).
  split. nra. split; [ | split].
  - intros H. destruct Free as (Dx & Cv & Dv). nra. split; [ | split].
    + unfold U. apply scaled_derive, Dx.
    + apply scaled_continuous, Cv.
    + intros N. rewrite sign_scaled. replace (cos (mu * w * t)) with (cos (w * (mu * t))) by (f_equal; ring).
      replace (U * mu * F * cos (w * (mu * t)) - U * mu * f * sign (v (mu * t)))
        with (U * mu * (F * cos (w * (mu * t)) - f * sign (v (mu * t)))) by ring.
      apply scaled_derive, Dv. intros Z. apply N. rewrite Z. ring.
  - intros E. destruct Right as (Cx & u & Hu & Ll & Ev & Lr). apply Rmult_eq_reg_l with lambda; lra.
    split. apply scaled_continuous, Cx. exists (U * u). split. nra.
    split. apply scaled_left; assumption. split. rewrite Ev. ring. apply scaled_right; assumption.
  - intros E. destruct Left as (Cx & u & Hu & Ll & Ev & Lr). apply Rmult_eq_reg_l with lambda; lra.
    split. apply scaled_continuous, Cx. exists (U * u). split. nra.
    split. apply scaled_left; assumption. split. rewrite Ev. ring. apply scaled_right; assumption.
Qed.

Lemma motion_scaled : forall a b x v, motion (mu * a) (mu * b) x v ->
  motion' a b (scaled_x x) (scaled_v v).
Proof.
  intros a b x v [Laws S1 S2 Lx Lv Rx Rv]. split.
  - intros t Ht. apply laws_scaled, Laws. nra.
  - nra.
  - nra.
  - apply scaled_right; assumption.
  - apply scaled_right; assumption.
  - apply scaled_left; assumption.
  - apply scaled_left; assumption.
Qed.

End Motions.

(** ** The map of the period *)

Section Image.

Variables lambda mu : R.
Hypothesis lambda_pos : 0 < lambda.
Hypothesis mu_pos : 0 < mu.
Variables F w f l r e : R.
Hypothesis w_not_0 : w <> 0.
Let U := lambda * mu.
Notation image := (image F w f l r e).
Notation image' := (Statement.image (U * mu * F) (mu * w) (U * mu * f) (lambda * l) (lambda * r) e).

Lemma T_scaled : mu * T (mu * w) = T w.
Proof. unfold T. field. split; lra. Qed.

Theorem image_scaled : forall a b y z, image a b y z ->
  image' (lambda * a) (U * b) (lambda * y) (U * z).
Proof.
  intros a b y z [(x & v & M & N & X0 & V0 & X1 & V1) Only].
  assert (P : 0 < U) by (apply Rmult_lt_0_compat; assumption). assert (E := T_scaled).
  assert (Z : mu * 0 = 0) by ring. split.
  - exists (fun t => lambda * x (mu * t)), (fun t => U * v (mu * t)).
    split. { apply motion_scaled; try assumption. rewrite Z, E. exact M. }
    split. { intros t Ht Hv. apply (N (mu * t)). rewrite <- E. nra.
      apply Rmult_eq_reg_l with U; lra. }
    rewrite Z, E, X0, V0, X1, V1. auto.
  - intros X V M' E0 E0'.
    assert (Li : 0 < / lambda) by (apply Rinv_0_lt_compat; assumption).
    assert (Mi : 0 < / mu) by (apply Rinv_0_lt_compat; assumption).
    assert (Back := motion_scaled (/ lambda) (/ mu) Li Mi (U * mu * F) (mu * w) (U * mu * f) (lambda * l)
      (lambda * r) e 0 (T w) X V).
    replace (/ mu * 0) with 0 in Back by ring.
    replace (/ mu * T w) with (T (mu * w)) in Back by (rewrite <- E; field; lra).
    specialize (Back M').
    replace (/ lambda * / mu * / mu * (U * mu * F)) with F in Back by (unfold U; field; split; lra).
    replace (/ mu * (mu * w)) with w in Back by (field; lra).
    replace (/ lambda * / mu * / mu * (U * mu * f)) with f in Back by (unfold U; field; split; lra).
    replace (/ lambda * (lambda * l)) with l in Back by (field; lra).
    replace (/ lambda * (lambda * r)) with r in Back by (field; lra).
    destruct (Only _ _ Back) as [R1 R2].
    + replace (/ mu * 0) with 0 by ring. rewrite E0. field. lra.
    + replace (/ mu * 0) with 0 by ring. rewrite E0'. unfold U. field. split; lra.
    + replace (/ mu * T w) with (T (mu * w)) in R1, R2 by (rewrite <- E; field; lra).
      split.
      * rewrite <- R1. field. lra.
      * rewrite <- R2. unfold U. field. split; lra.
Qed.

End Image.
