(** * The theorem from inequalities between numbers

    Given two flights that close up (OneOne.v), what remains are inequalities between explicit
    numbers: they are collected in [numbers_of], and give the theorem in units F = w = 1. *)

From Coq Require Import Reals Lra Lia ZArith.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Flight Periodic Plane Smooth Jet Taylor Symplectic Image Strobe Stages
  Expansion OneOne Dip Orbit Complex Frame Birkhoff Twist Moser Moeckel.
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

(** Two identities apart from the large terms to which they will be applied. *)

Lemma twice_half : forall z, z = 2 * (z / 2).
Proof. intros. field. Qed.

Lemma sign_cancels : forall s y z, s * s = 1 -> z <> 0 -> y / (s * z) = s * y / z.
Proof.
  intros s y z E N. transitivity (s * s * y / (s * z)). rewrite E, Rmult_1_l. reflexivity.
  field. split. exact N. intros Z. rewrite Z in E. lra.
Qed.

(** ** The numbers *)

Section Elliptic.

Variables f l r : R.
Hypothesis walls : l < r.
Hypothesis f_small : 0 < f < 1.

Variables t1 t2 u1 u2 : R.
Hypothesis orbit : closes f l r t1 t2 u1 u2.
Hypothesis order : 0 < t1 /\ t1 < t2 /\ PI / 2 < t2 /\ t2 < 2 * PI /\ t2 < t1 + 2 * PI /\ t1 < PI.

Notation T := (2 * PI).
Let x0 := start_x f l t2 u2.
Let v0 := start_v f t2 u2.

(** The speeds of which the smallest is the least speed. *)

Definition low_speeds : list R :=
  u1 :: u2 :: back_speed f t1 u1 (back_lowest f t1 t2)
     :: forth_speed f t2 u2 (forth_lowest f t1 t2) :: nil.

Definition state : around R :=
  Around f l r T x0 v0 t1 (sin t1) (cos t1) (/ u1) t2 (sin t2) (cos t2) (/ u2).

Let jx := fst (jmap real state).
Let jv := snd (jmap real state).
Let cs := (c10 jx + c01 jv) / 2.

Variable sign : R.

Record numbers (c : claims) : Prop := {
  n_moving : 0 < lo (least_speed c);
  n_slow : forall u, List.In u low_speeds -> lo (least_speed c) <= u;
  n_fast : exists u, List.In u low_speeds /\ u <= hi (least_speed c);
  n_hit_1 : within (hit_1 c) t1;
  n_hit_2 : within (hit_2 c) t2;
  n_speed_1 : within (speed_1 c) u1;
  n_speed_2 : within (speed_2 c) u2;
  n_forcing_1 : within (forcing_1 c) (Rabs (cos t1) - f);
  n_forcing_2 : within (forcing_2 c) (Rabs (cos t2) - f);
  n_box : forall a b, within (box_x c) a -> within (box_v c) b ->
    (exists y z, image 1 1 f l r 1 a b y z) /\ (image 1 1 f l r 1 a b a b -> a = x0 /\ b = v0);
  n_x : within (box_x c) x0;
  n_v : within (box_v c) v0;
  n_jx : within_jet (taylor_x c) jx;
  n_jv : within_jet (taylor_v c) jv;
  n_trace : within (trace c) (c10 jx + c01 jv);
  n_elliptic : -1 < cs < 1;
  n_not_3 : 2 * cs + 1 <> 0;
  n_not_4 : cs <> 0;
  n_sign : sign * sign = 1 /\ 0 < sign * c10 jv;
  n_angle : within (angle c) (sign * angle_at cs);
  n_rotation : within (rotation c) (angle_at cs / T);
  n_twist : within (twist c) (moeckel real jx jv cs (sign * sqrt (1 - cs * cs))
    ((cs - c10 jx) / c10 jv) (sign * sqrt (1 - cs * cs) / c10 jv));
  n_twist_not_0 : moeckel real jx jv cs (sign * sqrt (1 - cs * cs))
    ((cs - c10 jx) / c10 jv) (sign * sqrt (1 - cs * cs) / c10 jv) <> 0 }.

(** The least speed. *)

Lemma speeds_above : forall m, (forall u, List.In u low_speeds -> m <= u) ->
  (forall t, t1 <= t <= t2 -> m <= back_speed f t1 u1 t) /\
  (forall t, t2 <= t <= t1 + T -> m <= forth_speed f t2 u2 t).
Proof.
  intros m H. unfold low_speeds in H. simpl in H. split; intros t Ht.
  - assert (B := back_least f l r t1 t2 u1 u2 f_small order orbit t Ht).
    assert (H1 := H _ (or_intror (or_introl eq_refl))).
    assert (H2 := H _ (or_intror (or_intror (or_introl eq_refl)))).
    revert B. apply Rmin_case; lra.
  - assert (B := forth_least f l r t1 t2 u1 u2 f_small order orbit t Ht).
    assert (H1 := H _ (or_introl eq_refl)).
    assert (H2 := H _ (or_intror (or_intror (or_intror (or_introl eq_refl))))).
    revert B. apply Rmin_case; lra.
Qed.

Theorem elliptic_of_numbers : forall c, numbers c -> elliptic_orbit 1 1 f l r c.
Proof.
  intros c N. assert (Pi := PI_RGT_0).
  destruct (speeds_above _ (n_slow c N)) as [Back Forth].
  assert (Moving := n_moving c N).
  assert (Ord : 0 < t1 /\ t1 < t2 /\ t2 < T) by lra.
  assert (Pass := orbit_passes f l r t1 t2 u1 u2 _ Ord orbit Moving Back Forth).
  assert (Ret := orbit_returns f l r t1 t2 u1 u2 orbit).
  destruct (starts f l r t1 t2 u1 u2 orbit) as (_ & _ & A1 & A2).
  destruct (orbit_motion f l r walls t1 t2 u1 u2 _ Ord orbit Moving Back Forth)
    as (x & v & Laws & Per & Speed & Hits & X0 & V0 & V1 & V2 & On1 & On2).
  assert (HT := T_1).
  unfold elliptic_orbit. exists x, v, t1, t2. rewrite HT.
  split. exact Laws. split. exact Per. split. exact Speed.
  split.
  { destruct (n_fast c N) as [u [Hu Le]]. unfold low_speeds in Hu. simpl in Hu.
    destruct Hu as [E | [E | [E | [E | []]]]]; subst u.
    - exists t1. rewrite V1, Rabs_Ropp. destruct (speeds f l r t1 t2 u1 u2 _ Ord orbit Back Forth).
      rewrite Rabs_pos_eq; lra.
    - exists t2. rewrite V2. destruct (speeds f l r t1 t2 u1 u2 _ Ord orbit Back Forth).
      rewrite Rabs_pos_eq; lra.
    - exists (back_lowest f t1 t2). rewrite On1. exact Le. unfold back_lowest. split. apply Rmax_l.
      apply Rmax_lub. lra. apply Rmin_r.
    - exists (forth_lowest f t1 t2). rewrite On2. exact Le. unfold forth_lowest. split. apply Rmax_l.
      apply Rmax_lub. lra. apply Rmin_r. }
  split. exact Hits. split. apply N. split. apply N.
  split. rewrite V1, Ropp_involutive. apply N. split. rewrite V2. apply N.
  rewrite !Rmult_1_l. split. apply N. split. apply N.
  rewrite X0, V0. fold x0 v0.
  split. exact (n_box c N). split. apply N. split. apply N.
  (* the map *)
  destruct (hits_exist f l r x0 v0 t1 t2 Pass) as (H & G & HG).
  set (X := fun a b => end_x f l b (H a b) (G a b)). set (V := fun a b => end_v f b (H a b) (G a b)).
  assert (FX : X x0 v0 = x0 /\ V x0 v0 = v0).
  { unfold X, V. rewrite (h_first _ _ _ _ _ _ _ _ _ HG), (h_second _ _ _ _ _ _ _ _ _ HG). exact Ret. }
  destruct FX as [FX FV].
  destruct (map_smooth f l r x0 v0 t1 t2 H G HG) as [SX SV]. fold X V in SX, SV.
  assert (Area := map_area f l r x0 v0 t1 t2 H G HG). fold X V in Area.
  assert (Im := map_image f l r walls x0 v0 t1 t2 H G HG).
  destruct (map_expands f l r x0 v0 t1 t2 Pass H G HG) as [EX EV].
  assert (Ar : around_orbit f l r x0 v0 t1 t2 = state).
  { unfold around_orbit, state. fold v0 in A1, A2. rewrite A1, A2. reflexivity. }
  rewrite Ar in EX, EV. fold jx in EX. fold jv in EV. fold X in EX. fold V in EV.
  assert (Sy := area_symplectic X V x0 v0 jx jv SX SV Area EX EV).
  exists X, V, jx, jv.
  split. exact Im. split. exact FX. split. exact FV. split. exact SX. split. exact SV.
  split. exact Area. split. exact EX. split. exact EV. split. apply N. split. apply N.
  split. apply (s_0 _ _ Sy). split. apply N.
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
    apply sign_cancels; assumption. }
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
  split. rewrite Cos. apply twice_half. split. rewrite Abs. exact Bd.
  split. apply N. split. rewrite Abs. apply N. split. exact NR. split. exact NF.
  split. rewrite Tau. apply N. split. rewrite Tau. apply N.
  split. { intros tau NF'. eapply (twist_unique X V x0 v0 jx jv Theta wr wi); eassumption. }
  apply (stable_if_Moser X V x0 v0 _ Im Theta (tau1 jx jv Theta wr wi) FX FV SX SV Area NF NR).
  rewrite Tau. apply N.
Qed.

End Elliptic.
