(** * The symmetric orbits: d = 0

    Their equations (a), (c) of OneOne.v have two solutions,

      C = pi f/2,   S = s sqrt(1 - C^2), s = 1 or -1,   W = (r - l + 2 S)/pi.

    An orbit with d <> 0 has S G(d) = r - l (Asymmetric.v) and C = pi f/(2 cos d); where this is
    impossible for all d <> 0 of an interval around 0, the symmetric orbit with this s is alone. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Plane OneOne Asymmetric.
Open Scope R_scope.

Section Symmetric.

Variables f l r s : R.
Hypothesis f_pos : 0 < f.
Hypothesis sign : s = 1 \/ s = -1.

Notation closed := (closed f l r).

Definition C_sym : R := PI * f / 2.
Definition S_sym : R := s * sqrt (1 - C_sym * C_sym).
Definition W_sym : R := (r - l + 2 * S_sym) / PI.
Definition phi_sym : R := angle_of S_sym C_sym.

Lemma C_sym_pos : 0 < C_sym.
Proof. assert (P := PI_RGT_0). unfold C_sym. nra. Qed.

Theorem symmetric : C_sym < 1 -> closed 0 S_sym C_sym W_sym phi_sym.
Proof.
  intros H. assert (P := PI_RGT_0). assert (Cp := C_sym_pos).
  assert (Q : C_sym * C_sym + S_sym * S_sym = 1).
  { unfold S_sym. assert (E : sqrt (1 - C_sym * C_sym) * sqrt (1 - C_sym * C_sym) = 1 - C_sym * C_sym)
      by (apply sqrt_sqrt; nra).
    replace (s * sqrt (1 - C_sym * C_sym) * (s * sqrt (1 - C_sym * C_sym)))
      with (s * s * (sqrt (1 - C_sym * C_sym) * sqrt (1 - C_sym * C_sym))) by ring.
    rewrite E. destruct sign as [-> | ->]; ring. }
  destruct (angle_of_is _ _ Cp Q) as [Es Ec].
  split; auto; rewrite ?cos_0, ?sin_0.
  - unfold C_sym. field.
  - ring.
  - unfold W_sym. field. lra.
Qed.

(** The sign of S is that of - phi. *)

Lemma sign_of_S : forall d S C W phi, closed d S C W phi -> - (PI / 2) < phi < PI / 2 ->
  s * phi < 0 -> 0 < C /\ C * C + S * S = 1 /\ S = s * sqrt (1 - C * C) /\ 0 < s * S.
Proof.
  intros d S C W phi [Es Ec _ _ _] H Hs. assert (P := PI_RGT_0).
  assert (Cp : 0 < C) by (rewrite <- Ec; apply cos_gt_0; lra).
  assert (Q := sin2_cos2 phi). unfold Rsqr in Q. rewrite Es, Ec in Q.
  split. exact Cp. split. lra. destruct sign as [-> | ->].
  - assert (sin phi < 0) by (apply sin_lt_0_var; lra).
    replace (1 - C * C) with (S * S) by lra. rewrite sqrt_square; lra.
  - assert (0 < sin phi) by (apply sin_gt_0; lra).
    replace (1 - C * C) with (- S * - S) by lra. rewrite sqrt_square; lra.
Qed.

Theorem symmetric_unique : forall S C W phi, closed 0 S C W phi -> - (PI / 2) < phi < PI / 2 ->
  s * phi < 0 -> W = W_sym /\ phi = phi_sym.
Proof.
  intros S C W phi H B Hs. destruct (sign_of_S _ _ _ _ _ H B Hs) as (Cp & _ & ES & _).
  destruct H as [Es Ec Ea _ Ecc]. assert (P := PI_RGT_0). rewrite cos_0 in *. rewrite sin_0 in *.
  assert (EC : C = C_sym) by (unfold C_sym; lra).
  assert (E : S = S_sym) by (unfold S_sym; rewrite <- EC; exact ES).
  split.
  - unfold W_sym. rewrite <- E, <- Ecc. field. lra.
  - unfold phi_sym. rewrite <- E, <- EC. apply angle_of_unique; assumption.
Qed.

(** ** Alone *)

Definition C_at (d : R) : R := PI * f / (2 * cos d).

Definition impossible (d : R) : Prop := 0 < cos d /\
  (s = 1 -> sqrt (1 - C_at d * C_at d) * G d <> r - l) /\ (s = -1 -> 0 <= G d).

Theorem alone : forall d S C W phi, l < r -> (d <> 0 -> impossible d) -> closed d S C W phi ->
  - (PI / 2) < phi < PI / 2 -> s * phi < 0 -> d = 0.
Proof.
  intros d S C W phi Walls Imp H B Hs. destruct (Req_dec d 0) as [ | N]. assumption. exfalso.
  destruct (Imp N) as (Cd & Plus & Minus).
  destruct (sign_of_S _ _ _ _ _ H B Hs) as (Cp & _ & ES & Sp).
  destruct (S_and_W f l r d S C W phi N H) as [HS _].
  destruct H as [Es Ec Ea Eb Ecc]. assert (P := PI_RGT_0).
  assert (EC : C = C_at d) by (unfold C_at; apply Rmult_eq_reg_r with (2 * cos d);
    [ rewrite <- Rmult_assoc, (Rmult_comm C 2), Ea; field; lra | lra ]).
  destruct sign as [E | E].
  - apply (Plus E). rewrite <- HS, ES, EC, E. ring.
  - specialize (Minus E). rewrite E in Sp. nra.
Qed.

(** sin d/d is a value of the cosine between 0 and d. *)

Lemma sinc_is_cos : forall d, d <> 0 -> exists c, Rmin 0 d <= c <= Rmax 0 d /\ sin d / d = cos c.
Proof.
  intros d N. destruct (MVT_between sin cos 0 d) as [c [Hc E]]. intros. apply is_derive_sin.
  exists c. split. exact Hc. rewrite sin_0, !Rminus_0_r in E. rewrite E. field. exact N.
Qed.

End Symmetric.
