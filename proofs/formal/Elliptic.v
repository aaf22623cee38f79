(** * The elliptic theorem from inequalities between numbers

    The orbit, its map and their numbers (Numbers.v) are given; what makes the orbit elliptic are a
    few more inequalities, in units F = w = 1. *)

From Coq Require Import Reals Lra Lia ZArith.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Periodic Jet Symplectic Image OneOne Complex Frame Birkhoff Twist Moser Moeckel
  Numbers.
Open Scope R_scope.

(** ** The angle *)

Definition angle_at (cs : R) : R := PI / 2 - atan (cs / sqrt (1 - cs * cs)).

Lemma angle_at_is : forall cs, -1 < cs < 1 ->
  cos (angle_at cs) = cs /\ sin (angle_at cs) = sqrt (1 - cs * cs) /\ 0 < angle_at cs < PI.
Proof.
  intros cs H. assert (Q : 0 < 1 - cs * cs) by nra. assert (P := sqrt_lt_R0 _ Q).
  assert (E : sqrt (1 - cs * cs) * sqrt (1 - cs * cs) + cs * cs = 1) by (rewrite sqrt_sqrt; lra).
  destruct (angle_of_is cs _ P E) as [Es Ec]. unfold angle_of in Es, Ec.
  rewrite sin_neg in Es. rewrite cos_neg in Ec.
  unfold angle_at. rewrite cos_shift, sin_shift. split. lra. split. exact Ec.
  assert (B := atan_bound (cs / sqrt (1 - cs * cs))). lra.
Qed.

Lemma not_resonant : forall Theta, cos Theta <> 1 -> cos Theta <> -1 -> 2 * cos Theta + 1 <> 0 ->
  cos Theta <> 0 -> nonresonant Theta.
Proof.
  intros Theta N1 N2 N3 N4 k n Hk E.
  assert (One : cos (IZR k * Theta) = 1).
  { rewrite E, <- (Rplus_0_l (IZR n * (2 * PI))), cos_turn. apply cos_0. }
  assert (Q := sin2_cos2 Theta). unfold Rsqr in Q.
  assert (D2 : cos (2 * Theta) = 2 * cos Theta * cos Theta - 1) by apply cos_2a_cos.
  assert (S2 : sin (2 * Theta) = 2 * sin Theta * cos Theta) by apply sin_2a.
  set (c := cos Theta) in *. set (s := sin Theta) in *.
  assert (K : (k = 1 \/ k = 2 \/ k = 3 \/ k = 4)%Z) by lia.
  destruct K as [-> | [-> | [-> | ->]]].
  - rewrite Rmult_1_l in One. contradiction.
  - rewrite D2 in One. assert (P : (c - 1) * (c + 1) = 0) by lra.
    apply Rmult_integral in P. destruct P; lra.
  - replace (3 * Theta) with (2 * Theta + Theta) in One by ring.
    rewrite cos_plus, D2, S2 in One. fold c s in One.
    assert (E3 : 2 * s * c * s = 2 * c * (1 - c * c)) by (replace (1 - c * c) with (s * s) by lra; ring).
    assert (P : (c - 1) * ((2 * c + 1) * (2 * c + 1)) = 0) by lra.
    apply Rmult_integral in P. destruct P as [P | P]. lra.
    apply Rmult_integral in P. destruct P; contradiction.
  - replace (4 * Theta) with (2 * (2 * Theta)) in One by ring.
    rewrite cos_2a_cos, D2 in One. assert (P : (c * c) * ((c - 1) * (c + 1)) = 0) by lra.
    apply Rmult_integral in P. destruct P as [P | P]; apply Rmult_integral in P; destruct P; lra.
Qed.

(** ** The numbers *)

Section Elliptic.

Variables f l r x0 v0 : R.
Variables jx jv : jet R.
Let cs := (c10 jx + c01 jv) / 2.

Variable sign : R.

Record elliptic_numbers (c : elliptic_claims) : Prop := {
  n_jx : within_jet (taylor_x c) jx;
  n_jv : within_jet (taylor_v c) jv;
  n_elliptic : -1 < cs < 1;
  n_not_3 : 2 * cs + 1 <> 0;
  n_not_4 : cs <> 0;
  n_sign : sign * sign = 1 /\ 0 < sign * c10 jv;
  n_angle : within (angle c) (sign * angle_at cs);
  n_rotation : within (rotation c) (angle_at cs / (2 * PI));
  n_twist : within (twist c) (moeckel real jx jv cs (sign * sqrt (1 - cs * cs))
    ((cs - c10 jx) / c10 jv) (sign * sqrt (1 - cs * cs) / c10 jv));
  n_twist_not_0 : moeckel real jx jv cs (sign * sqrt (1 - cs * cs))
    ((cs - c10 jx) / c10 jv) (sign * sqrt (1 - cs * cs) / c10 jv) <> 0 }.

Theorem elliptic_of_numbers : forall c X V, elliptic_numbers c ->
  map_known f l r x0 v0 jx jv X V -> elliptic 1 1 f l r c X V x0 v0 jx jv.
Proof.
  intros c X V N [Im FX FV SX SV Area EX EV Sy].
  split. apply N. split. apply N.
  (* the angle *)
  destruct (n_sign c N) as [Sq Sg]. assert (El := n_elliptic c N).
  destruct (angle_at_is cs El) as (Ec & Es & Bd).
  assert (Sabs : sign = 1 \/ sign = -1).
  { assert (P : (sign - 1) * (sign + 1) = 0) by lra. apply Rmult_integral in P. destruct P; lra. }
  set (Theta := sign * angle_at cs).
  assert (Abs : Rabs Theta = angle_at cs).
  { unfold Theta. destruct Sabs as [-> | ->].
    rewrite Rmult_1_l. apply Rabs_pos_eq. lra.
    replace (-1 * angle_at cs) with (- angle_at cs) by ring. rewrite Rabs_Ropp. apply Rabs_pos_eq. lra. }
  assert (Cos : cos Theta = cs).
  { unfold Theta. destruct Sabs as [-> | ->]. rewrite Rmult_1_l. exact Ec.
    replace (-1 * angle_at cs) with (- angle_at cs) by ring. rewrite cos_neg. exact Ec. }
  assert (Sin : sin Theta = sign * sqrt (1 - cs * cs)).
  { unfold Theta. destruct Sabs as [-> | ->]. rewrite !Rmult_1_l. exact Es.
    replace (-1 * angle_at cs) with (- angle_at cs) by ring. rewrite sin_neg, Es. ring. }
  assert (Root : 0 < sqrt (1 - cs * cs)) by (apply sqrt_lt_R0; nra).
  assert (Cne : c10 jv <> 0). { intros Z. rewrite Z in Sg. lra. }
  assert (Fr := frame_exists jx jv sign Sy Sq ltac:(unfold cs in El; lra) Cne).
  cbv zeta in Fr. fold cs in Fr.
  set (wr := (cs - c10 jx) / c10 jv) in *. set (wi := sign * sqrt (1 - cs * cs) / c10 jv) in *.
  assert (Fr' : frame jx jv (cos Theta) (sin Theta) wr wi) by (rewrite Cos, Sin; exact Fr).
  assert (Wi : 0 < wi).
  { unfold wi. replace (sign * sqrt (1 - cs * cs) / c10 jv)
      with (sqrt (1 - cs * cs) / (sign * c10 jv)).
    apply Rdiv_lt_0_compat; assumption.
    transitivity ((sign * sign) * sqrt (1 - cs * cs) / (sign * c10 jv)). rewrite Sq, Rmult_1_l. reflexivity.
    field. split. exact Cne. intros Z. rewrite Z in Sg. lra. }
  assert (N1 : cos Theta <> 1) by (rewrite Cos; lra).
  assert (N2 : sin Theta <> 0).
  { rewrite Sin. apply Rmult_integral_contrapositive_currified; lra. }
  assert (N3 : 2 * cos Theta + 1 <> 0) by (rewrite Cos; apply N).
  assert (N4 : cos Theta <> 0) by (rewrite Cos; apply N).
  assert (NR : nonresonant Theta) by (apply not_resonant; auto; rewrite Cos; lra).
  assert (Tau : tau1 jx jv Theta wr wi = moeckel real jx jv cs (sign * sqrt (1 - cs * cs)) wr wi).
  { rewrite moeckel_is. unfold tau1. rewrite Cos, Sin. reflexivity. }
  assert (NF := twist_exists X V x0 v0 jx jv Theta wr wi EX EV FX FV Fr' Sy Wi N1 N2 N3 N4).
  exists Theta, (tau1 jx jv Theta wr wi).
  split. rewrite Cos. unfold cs. field. split. rewrite Abs. exact Bd.
  split. apply N. split. rewrite Abs. apply N. split. exact NR. split. exact NF.
  split. rewrite Tau. apply N. split. rewrite Tau. apply N.
  split. { intros tau NF'. eapply (twist_unique X V x0 v0 jx jv Theta wr wi); eassumption. }
  apply (stable_if_Moser X V x0 v0 _ Im Theta (tau1 jx jv Theta wr wi) FX FV SX SV Area NF NR).
  rewrite Tau. apply N.
Qed.

End Elliptic.
