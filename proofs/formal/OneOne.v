(** * Orbits with one hit of each wall per period: the equations

    Let t1, t2 be the hits of the right and of the left wall, u1, u2 the speeds at them, and

      t2 - t1 = pi + 2 d,   phi = (t1 + t2)/2 - pi,   u1 = W + f d,   u2 = W - f d,
      C = cos phi,   S = - sin phi.

    The two flights close up if and only if

      (a) 2 C cos d = pi f,   (b) 2 W d = pi S sin d,   (c) pi W - 2 S (cos d + d sin d) = r - l. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Flight.
Open Scope R_scope.

Definition hit1 (d phi : R) : R := phi + PI / 2 - d.
Definition hit2 (d phi : R) : R := phi + 3 * (PI / 2) + d.
Definition speed1 (f d W : R) : R := W + f * d.
Definition speed2 (f d W : R) : R := W - f * d.

Section OneOne.

Variables f l r : R.

Notation vel := (vel f).
Notation pos := (pos f).

Record closed (d S C W phi : R) : Prop := {
  c_sin : sin phi = - S;
  c_cos : cos phi = C;
  c_a : 2 * C * cos d = PI * f;
  c_b : 2 * W * d = PI * S * sin d;
  c_c : PI * W - 2 * S * (cos d + d * sin d) = r - l }.

(** ** Sine and cosine of the hit times *)

Section Times.

Variables d S C phi : R.
Hypothesis sin_phi : sin phi = - S.
Hypothesis cos_phi : cos phi = C.

Lemma sin_hit1 : sin (hit1 d phi) = C * cos d - S * sin d.
Proof.
  replace (hit1 d phi) with (PI / 2 + (phi - d)) by (unfold hit1; ring).
  rewrite <- cos_sin, cos_minus, sin_phi, cos_phi. ring.
Qed.

Lemma cos_hit1 : cos (hit1 d phi) = S * cos d + C * sin d.
Proof.
  replace (hit1 d phi) with (PI / 2 - (d - phi)) by (unfold hit1; ring).
  rewrite cos_shift, sin_minus, sin_phi, cos_phi. ring.
Qed.

Lemma sin_hit2 : sin (hit2 d phi) = - (C * cos d + S * sin d).
Proof.
  replace (hit2 d phi) with ((PI / 2 + (phi + d)) + PI) by (unfold hit2; field).
  rewrite neg_sin, <- cos_sin, cos_plus, sin_phi, cos_phi. ring.
Qed.

Lemma cos_hit2 : cos (hit2 d phi) = C * sin d - S * cos d.
Proof.
  replace (hit2 d phi) with ((PI / 2 - - (phi + d)) + PI) by (unfold hit2; field).
  rewrite neg_cos, cos_shift, sin_neg, sin_plus, sin_phi, cos_phi. ring.
Qed.

End Times.

Lemma between_hits : forall d phi, hit2 d phi - hit1 d phi = PI + 2 * d.
Proof. intros. unfold hit1, hit2. field. Qed.

Lemma back : forall d phi, hit1 d phi + 2 * PI - hit2 d phi = PI - 2 * d.
Proof. intros. unfold hit1, hit2. field. Qed.

Lemma sin_again : forall t, sin (t + 2 * PI) = sin t.
Proof. intros. rewrite sin_plus, sin_2PI, cos_2PI. ring. Qed.

Lemma cos_again : forall t, cos (t + 2 * PI) = cos t.
Proof. intros. rewrite cos_plus, sin_2PI, cos_2PI. ring. Qed.

(** ** Two flights that close up *)

Record closes (t1 t2 u1 u2 : R) : Prop := {
  l_position : pos (-1) t1 r (- u1) t2 = l;
  l_speed : vel (-1) t1 (- u1) t2 = - u2;
  r_position : pos 1 t2 l u2 (t1 + 2 * PI) = r;
  r_speed : vel 1 t2 u2 (t1 + 2 * PI) = u1 }.

Theorem sufficient : forall d S C W phi, closed d S C W phi ->
  closes (hit1 d phi) (hit2 d phi) (speed1 f d W) (speed2 f d W).
Proof.
  intros d S C W phi [Es Ec Ea Eb Ecc].
  assert (S1 := sin_hit1 d S C phi Es Ec). assert (C1 := cos_hit1 d S C phi Es Ec).
  assert (S2 := sin_hit2 d S C phi Es Ec). assert (C2 := cos_hit2 d S C phi Es Ec).
  split.
  - unfold Flight.pos. rewrite between_hits, S1, C1, C2. unfold speed1. apply Rminus_diag_uniq.
    transitivity ((r - l) - (PI * W - 2 * S * (cos d + d * sin d)) + (PI * S * sin d - 2 * W * d)
                  + (PI + 2 * d) / 2 * (PI * f - 2 * C * cos d)).
    field. rewrite Ea, Eb, Ecc. ring.
  - unfold Flight.vel. rewrite between_hits, S1, S2. unfold speed1, speed2. apply Rminus_diag_uniq.
    transitivity (PI * f - 2 * C * cos d). ring. rewrite Ea. ring.
  - unfold Flight.pos. rewrite back, cos_again, S2, C1, C2. unfold speed2. apply Rminus_diag_uniq.
    transitivity ((PI * W - 2 * S * (cos d + d * sin d)) - (r - l) + (PI * S * sin d - 2 * W * d)
                  + (PI - 2 * d) / 2 * (2 * C * cos d - PI * f)).
    field. rewrite Ea, Eb, Ecc. ring.
  - unfold Flight.vel. rewrite back, sin_again, S1, S2. unfold speed1, speed2.
    apply Rminus_diag_uniq. transitivity (2 * C * cos d - PI * f). ring. rewrite Ea. ring.
Qed.

Theorem necessary : forall t1 t2 u1 u2, closes t1 t2 u1 u2 ->
  let d := (t2 - t1 - PI) / 2 in let phi := (t1 + t2) / 2 - PI in let W := u1 - f * d in
  closed d (- sin phi) (cos phi) W phi /\
  t1 = hit1 d phi /\ t2 = hit2 d phi /\ u1 = speed1 f d W /\ u2 = speed2 f d W.
Proof.
  intros t1 t2 u1 u2 [Lp Ls Rp Rs] d phi W.
  set (S := - sin phi). set (C := cos phi).
  assert (E1 : t1 = hit1 d phi) by (unfold hit1, d, phi; field).
  assert (E2 : t2 = hit2 d phi) by (unfold hit2, d, phi; field).
  assert (Es : sin phi = - S) by (unfold S; ring).
  assert (S1 := sin_hit1 d S C phi Es eq_refl). assert (C1 := cos_hit1 d S C phi Es eq_refl).
  assert (S2 := sin_hit2 d S C phi Es eq_refl). assert (C2 := cos_hit2 d S C phi Es eq_refl).
  rewrite <- E1 in S1, C1. rewrite <- E2 in S2, C2.
  assert (D1 : t2 - t1 = PI + 2 * d) by (unfold d; field).
  assert (D2 : t1 + 2 * PI - t2 = PI - 2 * d) by (unfold d; field).
  unfold Flight.pos, Flight.vel in *.
  rewrite sin_again in Rs. rewrite cos_again in Rp. rewrite D1 in *. rewrite D2 in *.
  rewrite S1, S2 in *. rewrite C1, C2 in *.
  assert (Ea : 2 * C * cos d = PI * f) by lra.
  assert (W1 : u1 = W + f * d) by (unfold W; ring).
  assert (W2 : u2 = W - f * d) by (unfold W; lra).
  rewrite W1 in Lp. rewrite W2 in Rp.
  assert (A : (r - l) - (PI * W - 2 * S * (cos d + d * sin d)) + (PI * S * sin d - 2 * W * d) = 0).
  { transitivity ((r - l) - (PI * W - 2 * S * (cos d + d * sin d)) + (PI * S * sin d - 2 * W * d)
                  + (PI + 2 * d) / 2 * (PI * f - 2 * C * cos d)).
    rewrite Ea. ring. rewrite <- Lp. field. }
  assert (B : (PI * W - 2 * S * (cos d + d * sin d)) - (r - l) + (PI * S * sin d - 2 * W * d) = 0).
  { transitivity ((PI * W - 2 * S * (cos d + d * sin d)) - (r - l) + (PI * S * sin d - 2 * W * d)
                  + (PI - 2 * d) / 2 * (2 * C * cos d - PI * f)).
    rewrite Ea. ring. rewrite <- Rp. field. }
  split. { split; auto; lra. }
  auto.
Qed.

(** ** The angle phi of given C > 0 and S *)

Definition angle_of (S C : R) : R := - atan (S / C).

Lemma angle_of_is : forall S C, 0 < C -> C * C + S * S = 1 ->
  sin (angle_of S C) = - S /\ cos (angle_of S C) = C.
Proof.
  intros S C P Q. unfold angle_of. rewrite sin_neg, cos_neg, sin_atan, cos_atan.
  assert (E : sqrt (1 + (S / C)²) = / C).
  { replace (1 + (S / C)²) with (/ C * / C).
    apply sqrt_square. left. apply Rinv_0_lt_compat, P.
    transitivity ((C * C + S * S) / (C * C)). rewrite Q. field. lra. unfold Rsqr. field. lra. }
  rewrite E. split; field; lra.
Qed.

Lemma angle_of_unique : forall phi S C, - (PI / 2) < phi < PI / 2 -> sin phi = - S ->
  cos phi = C -> phi = angle_of S C.
Proof.
  intros phi S C H Es Ec. assert (P : 0 < C) by (rewrite <- Ec; apply cos_gt_0; lra).
  assert (Q : C * C + S * S = 1).
  { assert (Q := sin2_cos2 phi). unfold Rsqr in Q. rewrite Es, Ec in Q. lra. }
  apply sin_inj.
  - lra.
  - unfold angle_of. destruct (atan_bound (S / C)). lra.
  - rewrite Es. symmetry. apply (angle_of_is S C P Q).
Qed.

End OneOne.
