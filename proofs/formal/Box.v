(** * States of period 2 pi in a box

    A state that [passes], with hits at s1 and s2, and returns to itself is one of the orbits of
    OneOne.v, given by d = (s2 - s1 - pi)/2 and phi = (s1 + s2)/2 - pi.  If for all states of the
    box the hits exist, with d and phi in intervals where there is one orbit at most, then at most
    one state returns.  There is one at most where [friction] is monotone, if d is not 0; and where
    none is but the symmetric one. *)

From Coq Require Import Reals Lra Ranalysis5.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Flight Hits Image OneOne Asymmetric Symmetric Dip Orbit.
Open Scope R_scope.

Section Box.

Variables f l r : R.
Hypothesis walls : l < r.

Notation vel := (vel f).
Notation pos := (pos f).
Notation image := (image 1 1 f l r 1).
Notation passes := (passes f l r).
Notation after1 := (after1 f).
Notation after2 := (after2 f).

(** ** A state that returns is an orbit of the closed form *)

Lemma fixed_closes : forall a b s1 s2, passes a b s1 s2 -> image a b a b ->
  closes f l r s1 s2 (after1 b s1) (after2 b s1 s2) /\
  a = start_x f l s2 (after2 b s1 s2) /\ b = start_v f s2 (after2 b s1 s2).
Proof.
  intros a b s1 s2 P Im.
  destruct (image_unique f l r _ _ _ _ _ _ Im (passes_image f l r walls _ _ _ _ P)) as [Ea Eb].
  assert (Ea' : a = pos 1 s2 l (after2 b s1 s2) (2 * PI)) by exact Ea.
  assert (Eb' : b = vel 1 s2 (after2 b s1 s2) (2 * PI)) by exact Eb.
  split; [ | auto]. split.
  - apply P.
  - unfold Image.after2. ring.
  - rewrite <- pos_again, <- Ea', <- Eb'. apply P.
  - rewrite <- vel_again, <- Eb'. reflexivity.
Qed.

(** Where the hits of the states are known to be. *)

Definition hits_known (a b d_ d' phi_ phi' : R) : Prop := exists s1 s2, passes a b s1 s2 /\
  d_ <= (s2 - s1 - PI) / 2 <= d' /\ phi_ < (s1 + s2) / 2 - PI < phi'.

Lemma known_image : forall a b d_ d' phi_ phi', hits_known a b d_ d' phi_ phi' ->
  exists y z, image a b y z.
Proof.
  intros a b d_ d' phi_ phi' (s1 & s2 & P & _). eexists. eexists.
  apply (passes_image f l r walls _ _ _ _ P).
Qed.

Definition one_orbit (d_ d' phi_ phi' : R) : Prop := forall d S C W phi d2 S2 C2 W2 phi2,
  d_ <= d <= d' -> d_ <= d2 <= d' -> phi_ < phi < phi' -> phi_ < phi2 < phi' ->
  closed f l r d S C W phi -> closed f l r d2 S2 C2 W2 phi2 -> d = d2 /\ W = W2 /\ phi = phi2.

Theorem fixed_unique : forall (states : R -> R -> Prop) d_ d' phi_ phi', one_orbit d_ d' phi_ phi' ->
  (forall a b, states a b -> hits_known a b d_ d' phi_ phi') ->
  forall a b a2 b2, states a b -> states a2 b2 -> image a b a b -> image a2 b2 a2 b2 ->
  a = a2 /\ b = b2.
Proof.
  intros states d_ d' phi_ phi' One Known a b a2 b2 H H2 Im Im2.
  destruct (Known a b H) as (s1 & s2 & P & Hd & Hphi).
  destruct (Known a2 b2 H2) as (q1 & q2 & P2 & Hd2 & Hphi2).
  destruct (fixed_closes a b s1 s2 P Im) as (Cl & Ea & Eb).
  destruct (fixed_closes a2 b2 q1 q2 P2 Im2) as (Cl2 & Ea2 & Eb2).
  destruct (necessary f l r _ _ _ _ Cl) as (Eq & _ & E2 & _ & E4).
  destruct (necessary f l r _ _ _ _ Cl2) as (Eq2 & _ & F2 & _ & F4).
  destruct (One _ _ _ _ _ _ _ _ _ _ Hd Hd2 Hphi Hphi2 Eq Eq2) as (Ed & EW & Ephi).
  assert (Es : s2 = q2).
  { refine (eq_trans E2 (eq_trans _ (eq_sym F2))). rewrite Ed, Ephi. reflexivity. }
  assert (Eu : after2 b s1 s2 = after2 b2 q1 q2).
  { refine (eq_trans E4 (eq_trans _ (eq_sym F4))). unfold speed2. rewrite EW, Ed. reflexivity. }
  split.
  - refine (eq_trans Ea (eq_trans _ (eq_sym Ea2))). f_equal; assumption.
  - refine (eq_trans Eb (eq_trans _ (eq_sym Eb2))). f_equal; assumption.
Qed.

Lemma one_asymmetric : forall d_ d' s,
  (forall d, d_ <= d <= d' -> d <> 0 /\ r - l < G d) ->
  (forall d, d_ <= d <= d' -> 0 < s * friction' l r d) -> one_orbit d_ d' (- (PI / 2)) (PI / 2).
Proof.
  intros d_ d' s Reg Mono d S C W phi d2 S2 C2 W2 phi2 Hd Hd2 Hphi Hphi2 Cl Cl2.
  destruct (Reg d Hd) as [N Big]. destruct (Reg d2 Hd2) as [N2 Big2].
  destruct (asymmetric_unique f l r walls d N Big _ _ _ _ Cl Hphi) as (F1 & _ & _ & -> & ->).
  destruct (asymmetric_unique f l r walls d2 N2 Big2 _ _ _ _ Cl2 Hphi2) as (F2 & _ & _ & -> & ->).
  assert (E : d = d2).
  { apply (parameter_unique l r walls d_ d' Reg s Mono); auto. rewrite F1, F2. reflexivity. }
  rewrite E. auto.
Qed.

Lemma one_symmetric : forall d_ d' phi_ phi' s, s = 1 \/ s = -1 ->
  (forall phi, phi_ < phi < phi' -> - (PI / 2) < phi < PI / 2 /\ s * phi < 0) ->
  (forall d, d_ <= d <= d' -> d <> 0 -> impossible f l r s d) -> one_orbit d_ d' phi_ phi'.
Proof.
  intros d_ d' phi_ phi' s Hs Side Imp d S C W phi d2 S2 C2 W2 phi2 Hd Hd2 Hphi Hphi2 Cl Cl2.
  destruct (Side phi Hphi) as [B Sg]. destruct (Side phi2 Hphi2) as [B2 Sg2].
  assert (E := alone f l r s Hs d S C W phi walls (Imp d Hd) Cl B Sg).
  assert (E2 := alone f l r s Hs d2 S2 C2 W2 phi2 walls (Imp d2 Hd2) Cl2 B2 Sg2).
  rewrite E in Cl |- *. rewrite E2 in Cl2 |- *.
  destruct (symmetric_unique f l r s Hs S C W phi Cl B Sg) as [-> ->].
  destruct (symmetric_unique f l r s Hs S2 C2 W2 phi2 Cl2 B2 Sg2) as [-> ->]. auto.
Qed.

(** ** The hits of the states of a cell

    [t1_, t1'] and [t2_, t2'] bracket the hits; what holds of the hits is asked of all times in
    these brackets at which the wall is reached. *)

Section Cell.

Variables a b t1_ t1' t2_ t2' : R.
Hypothesis f_small : 0 < f < 1.
Hypothesis order : 0 < t1_ /\ t1_ < t1' /\ t1' < t2_ /\ t2_ < t2' /\ t2' < 2 * PI /\ PI / 2 < t2_ /\
  t1' < PI.
Hypothesis inside : l < a.

Definition at1 (s : R) : Prop := t1_ <= s <= t1' /\ pos 1 0 a b s = r.
Definition at2 (s q : R) : Prop := at1 s /\ t2_ <= q <= t2' /\ pos (-1) s r (- after1 b s) q = l.

Hypothesis early1 : pos 1 0 a b t1_ < r.
Hypothesis late1 : r < pos 1 0 a b t1'.
Hypothesis early2 : forall s, at1 s -> l < pos (-1) s r (- after1 b s) t2_.
Hypothesis late2 : forall s, at1 s -> pos (-1) s r (- after1 b s) t2' < l.

Hypothesis first : forall s, at1 s -> 0 < b /\ 0 < after1 b s.
Hypothesis second : forall s q, at2 s q ->
  0 < back_speed f s (after1 b s) (back_lowest f s q) /\ 0 < after2 b s q.
Hypothesis third : forall s q, at2 s q ->
  0 < forth_speed f q (after2 b s q) (Rmax q (2 * PI - turn f)) /\ 0 < end_v f b s q.
Hypothesis stop : forall s q, at2 s q -> end_x f l b s q < r.

Theorem cell_passes : exists s q, passes a b s q /\ at2 s q.
Proof.
  assert (Pi := PI_RGT_0). destruct (turn_is f f_small) as (_ & _ & Bt).
  destruct (IVT_interv (fun t => pos 1 0 a b t - r) t1_ t1') as [s [Hs Es]].
  { intros t _. apply continuity_pt_minus. apply continuity_pt_filterlim, pos_continuous.
    apply continuity_pt_const. intros ? ?. reflexivity. }
  { lra. } { lra. } { lra. }
  assert (As : at1 s) by (split; [exact Hs | lra]).
  destruct (IVT_interv (fun t => l - pos (-1) s r (- after1 b s) t) t2_ t2') as [q [Hq Eq]].
  { intros t _. apply continuity_pt_minus. apply continuity_pt_const. intros ? ?. reflexivity.
    apply continuity_pt_filterlim, pos_continuous. }
  { lra. } { specialize (early2 s As). lra. } { specialize (late2 s As). lra. }
  assert (Aq : at2 s q) by (split; [exact As | split; [exact Hq | lra]]).
  destruct (first s As) as [Hb U1]. destruct (second s q Aq) as [D2 U2].
  destruct (third s q Aq) as [D3 V3]. assert (X := stop s q Aq).
  exists s, q. split; [ | exact Aq]. split.
  - lra.
  - exact inside.
  - intros t Ht.
    assert (D := dip f (b + 2 * PI * f) f_small (2 * PI) (s + 2 * PI) ltac:(unfold low; lra)
      (t + 2 * PI) ltac:(lra)).
    replace (lowest f (2 * PI) (s + 2 * PI)) with (2 * PI) in D.
    2: { unfold lowest, low. rewrite Rmin_left, Rmax_left; lra. }
    unfold h in D. rewrite !sin_again, sin_2PI in D.
    unfold Image.after1, Flight.vel in *. rewrite sin_0 in *.
    revert D. apply Rmin_case; lra.
  - intros t Ht.
    assert (D := dip f (after1 b s + sin s + f * (s + PI)) f_small (s + PI) (q + PI)
      ltac:(unfold low; lra) (t + PI) ltac:(lra)).
    replace (lowest f (s + PI) (q + PI)) with (back_lowest f s q + PI) in D.
    2: { unfold lowest, back_lowest, low. rewrite Rplus_max_distr_r, Rplus_min_distr_r.
         do 2 f_equal. ring. }
    rewrite <- !back_speed_is in D. unfold Image.after2 in U2.
    unfold back_speed in D at 2 3. revert D. apply Rmin_case; lra.
  - intros t Ht.
    assert (D := dip f (after2 b s q - sin q + f * q) f_small q (2 * PI)
      ltac:(unfold low; lra) t ltac:(lra)).
    replace (lowest f q (2 * PI)) with (Rmax q (2 * PI - turn f)) in D.
    2: { unfold lowest, low. rewrite Rmin_left; lra. }
    rewrite <- !forth_speed_is in D. unfold end_v in V3.
    unfold forth_speed in D at 2 3. revert D. apply Rmin_case; lra.
  - apply As.
  - apply Aq.
  - exact X.
Qed.

End Cell.

End Box.
