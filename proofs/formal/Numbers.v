(** * The orbit and its map from inequalities between numbers

    Given two flights that close up (OneOne.v), what remains are inequalities between explicit
    numbers: they are collected in [orbit_numbers], and give all that elliptic orbits and saddles
    have in common, in units F = w = 1. *)

From Coq Require Import Reals Lra Lia ZArith.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Flight Periodic Plane Smooth Jet Taylor Symplectic Image Strobe Stages
  Expansion OneOne Dip Orbit.
Open Scope R_scope.

(** What is known of the map. *)

Record map_known (f l r x v : R) (jx jv : jet R) (X V : R -> R -> R) : Prop := {
  k_image : locally_2d (fun a b => image 1 1 f l r 1 a b (X a b) (V a b)) x v;
  k_X : X x v = x; k_V : V x v = v; k_smooth_X : smooth X x v; k_smooth_V : smooth V x v;
  k_area : preserves_area X V x v; k_expands_X : expands X x v jx; k_expands_V : expands V x v jv;
  k_symplectic : symplectic jx jv }.

Section Numbers.

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

Record orbit_numbers (c : orbit_claims) : Prop := {
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
  n_trace : within (trace c) (c10 jx + c01 jv) }.

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

Theorem orbit_of_numbers : forall c (more : (R -> R -> R) -> (R -> R -> R) -> R -> R -> jet R -> jet R -> Prop),
  orbit_numbers c ->
  (forall X V, map_known f l r x0 v0 jx jv X V -> more X V x0 v0 jx jv) -> orbit_with 1 1 f l r c more.
Proof.
  intros c more N More. assert (Pi := PI_RGT_0).
  destruct (speeds_above _ (n_slow c N)) as [Back Forth].
  assert (Moving := n_moving c N).
  assert (Ord : 0 < t1 /\ t1 < t2 /\ t2 < T) by lra.
  assert (Pass := orbit_passes f l r t1 t2 u1 u2 _ Ord orbit Moving Back Forth).
  assert (Ret := orbit_returns f l r t1 t2 u1 u2 orbit).
  destruct (starts f l r t1 t2 u1 u2 orbit) as (_ & _ & A1 & A2).
  destruct (orbit_motion f l r walls t1 t2 u1 u2 _ Ord orbit Moving Back Forth)
    as (x & v & Laws & Per & Speed & Hits & X0 & V0 & V1 & V2 & On1 & On2).
  assert (HT := T_1).
  unfold orbit_with. exists x, v, t1, t2. rewrite HT.
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
  split. exact Area. split. exact EX. split. exact EV. split. apply (s_0 _ _ Sy). split. apply N.
  apply More. split; assumption.
Qed.

End Numbers.
