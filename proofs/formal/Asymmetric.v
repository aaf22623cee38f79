(** * The asymmetric orbits: all of them, by one parameter d

    For d <> 0 the equations (a), (b), (c) of OneOne.v with C > 0 have one solution,

      G(d) = (pi^2/2) sin d/d - 2 cos d - 2 d sin d,    S = (r - l)/G,    C = sqrt(1 - S^2),
      W = (pi/2) S sin d/d,    f = (2/pi) cos d C  =: friction(d),

    if r - l < G(d).  So an orbit exists where [friction] passes f, and it is the only one where
    [friction] is monotone. *)

From Coq Require Import Reals Lra Ranalysis5.
From Coquelicot Require Import Coquelicot.
From Cap Require Import OneOne.
Open Scope R_scope.

Definition G (d : R) : R := PI ^ 2 / 2 * (sin d / d) - 2 * cos d - 2 * d * sin d.
Definition G' (d : R) : R := PI ^ 2 / 2 * ((d * cos d - sin d) / (d * d)) - 2 * d * cos d.

Section Asymmetric.

Variables f l r : R.
Hypothesis walls : l < r.

Notation closed := (closed f l r).

Definition S_of (d : R) : R := (r - l) / G d.
Definition C_of (d : R) : R := sqrt (1 - S_of d * S_of d).
Definition W_of (d : R) : R := PI / 2 * S_of d * (sin d / d).
Definition friction (d : R) : R := 2 / PI * cos d * C_of d.
Definition phi_of (d : R) : R := angle_of (S_of d) (C_of d).

(** ** The solution *)

Lemma S_and_W : forall d S C W phi, d <> 0 -> closed d S C W phi ->
  S * G d = r - l /\ W = PI / 2 * S * (sin d / d).
Proof.
  intros d S C W phi N [_ _ _ Eb Ecc].
  assert (EW : W = PI / 2 * S * (sin d / d)).
  { apply Rmult_eq_reg_r with (2 * d). 2: lra.
    replace (W * (2 * d)) with (2 * W * d) by ring. rewrite Eb. field. exact N. }
  split. 2: exact EW. rewrite <- Ecc, EW. unfold G. field. exact N.
Qed.

Section At.

Variable d : R.
Hypothesis d_not_0 : d <> 0.
Hypothesis G_big : r - l < G d.

Lemma S_small : 0 < S_of d < 1.
Proof.
  unfold S_of. split. apply Rdiv_lt_0_compat; lra.
  apply Rmult_lt_reg_r with (G d). lra. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
Qed.

Lemma C_pos : 0 < C_of d.
Proof. destruct S_small as [A B]. apply sqrt_lt_R0. nra. Qed.

Lemma C_square : C_of d * C_of d + S_of d * S_of d = 1.
Proof. destruct S_small as [A B]. unfold C_of. rewrite sqrt_sqrt; nra. Qed.

Theorem asymmetric : friction d = f -> closed d (S_of d) (C_of d) (W_of d) (phi_of d).
Proof.
  intros E. assert (P := PI_RGT_0). destruct (angle_of_is _ _ C_pos C_square) as [Es Ec].
  split; auto.
  - rewrite <- E. unfold friction. field. lra.
  - unfold W_of. field. exact d_not_0.
  - transitivity (S_of d * G d). unfold W_of, G. field. exact d_not_0. unfold S_of. field. lra.
Qed.

Theorem asymmetric_unique : forall S C W phi, closed d S C W phi -> - (PI / 2) < phi < PI / 2 ->
  friction d = f /\ S = S_of d /\ C = C_of d /\ W = W_of d /\ phi = phi_of d.
Proof.
  intros S C W phi Cl H. assert (Pi := PI_RGT_0).
  destruct (S_and_W d S C W phi d_not_0 Cl) as [HS EW]. destruct Cl as [Es Ec Ea _ _].
  assert (S1 : S = S_of d). { unfold S_of. rewrite <- HS. field. lra. }
  assert (P : 0 < C) by (rewrite <- Ec; apply cos_gt_0; lra).
  assert (Q := sin2_cos2 phi). unfold Rsqr in Q. rewrite Es, Ec in Q.
  assert (C1 : C = C_of d).
  { unfold C_of. rewrite <- S1. replace (1 - S * S) with (C * C) by lra.
    symmetry. apply sqrt_square. lra. }
  split. { unfold friction. rewrite <- C1.
    replace (2 / PI * cos d * C) with (/ PI * (2 * C * cos d)) by (field; lra).
    rewrite Ea. field. lra. }
  split. exact S1. split. exact C1. split. rewrite EW, S1. reflexivity.
  rewrite (angle_of_unique phi S C H Es Ec), S1, C1. reflexivity.
Qed.

(** ** The friction as a function of d *)

Definition friction' : R :=
  2 / PI * (cos d * (S_of d * ((r - l) * G' d / (G d * G d)) / C_of d) - sin d * C_of d).

Lemma friction_derive : is_derive friction d friction'.
Proof.
  assert (Sm := S_small). assert (Cp := C_pos). assert (Pi := PI_RGT_0).
  assert (DG : is_derive G d (G' d)).
  { unfold G. auto_derive. exact d_not_0. unfold G'. field. exact d_not_0. }
  assert (DS : is_derive S_of d (- (r - l) * G' d / (G d * G d))).
  { unfold S_of. evar_last.
    apply (is_derive_div (fun _ => r - l) G). apply @is_derive_const. exact DG. lra.
    unfold zero; simpl. field. lra. }
  assert (Q : 0 < 1 - S_of d * S_of d) by nra.
  assert (DC : is_derive C_of d (S_of d * ((r - l) * G' d / (G d * G d)) / C_of d)).
  { unfold C_of at 1. evar_last.
    apply (is_derive_sqrt (fun d => 1 - S_of d * S_of d)).
    apply (is_derive_minus (fun _ => 1) (fun d => S_of d * S_of d)).
    apply @is_derive_const. apply (is_derive_mult S_of S_of); [exact DS | exact DS | ].
    intros; apply Rmult_comm. exact Q.
    unfold minus, plus, opp, mult, zero; simpl. fold (C_of d). field. split; lra. }
  unfold friction. evar_last.
  apply (is_derive_mult (fun d => 2 / PI * cos d) C_of).
  apply (is_derive_scal cos d (2 / PI)). apply is_derive_cos. exact DC. intros; apply Rmult_comm.
  unfold plus, mult; simpl. unfold friction'. field. repeat split; lra.
Qed.

Lemma friction_continuous : continuity_pt friction d.
Proof.
  apply continuity_pt_filterlim, (ex_derive_continuous friction). eexists. apply friction_derive.
Qed.

End At.

(** ** Existence and uniqueness on an interval of d *)

Variables d0 d1 : R.
Hypothesis regular : forall d, d0 <= d <= d1 -> d <> 0 /\ r - l < G d.

Theorem parameter_exists : forall s, d0 < d1 ->
  s * (friction d0 - f) < 0 -> 0 < s * (friction d1 - f) ->
  exists d, d0 <= d <= d1 /\ friction d = f.
Proof.
  intros s H01 H0 H1.
  destruct (IVT_interv (fun d => s * (friction d - f)) d0 d1) as [d [Hd E]]; auto.
  - intros d Hd. destruct (regular d Hd) as [A B]. apply continuity_pt_mult.
    apply continuity_pt_const. intros ? ?. reflexivity.
    apply continuity_pt_minus. apply friction_continuous; assumption.
    apply continuity_pt_const. intros ? ?. reflexivity.
  - exists d. split. exact Hd. apply Rmult_integral in E. destruct E as [-> | E]; lra.
Qed.

Theorem parameter_unique : forall s, (forall d, d0 <= d <= d1 -> 0 < s * friction' d) ->
  forall d e, d0 <= d <= d1 -> d0 <= e <= d1 -> friction d = friction e -> d = e.
Proof.
  intros s Mono d e Hd He E.
  assert (Between : forall z, Rmin d e <= z <= Rmax d e -> d0 <= z <= d1).
  { intros z [A B]. split.
    apply Rle_trans with (2 := A). apply Rmin_glb; lra.
    apply Rle_trans with (1 := B). apply Rmax_lub; lra. }
  destruct (MVT_gen friction d e friction') as [c [Hc Q]].
  - intros z Hz. destruct (regular z) as [A B]. apply Between; lra. apply friction_derive; assumption.
  - intros z Hz. destruct (regular z) as [A B]. apply Between; lra.
    apply friction_continuous; assumption.
  - assert (P := Mono c (Between c Hc)). rewrite E, Rminus_eq_0 in Q.
    symmetry in Q. apply Rmult_integral in Q. destruct Q as [Q | Q]. rewrite Q in P. lra. lra.
Qed.

End Asymmetric.
