(** * One-sided limits, and induction along an interval

    A limit from the right at s concerns the times in some (s, s + d); so a property of all t in
    [a, b] follows if it passes from [a, s] to (s, s + d) and from [a, s) to s. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

Lemma at_right_of_continuous : forall (h : R -> R) t,
  continuous h t -> filterlim h (at_right t) (locally (h t)).
Proof.
  intros h t Hc. apply filterlim_filter_le_1 with (2 := Hc). apply filter_le_within.
Qed.

Lemma at_left_of_continuous : forall (h : R -> R) t,
  continuous h t -> filterlim h (at_left t) (locally (h t)).
Proof.
  intros h t Hc. apply filterlim_filter_le_1 with (2 := Hc). apply filter_le_within.
Qed.

Lemma at_right_elim : forall (P : R -> Prop) s,
  at_right s P -> exists d, 0 < d /\ forall t, s < t < s + d -> P t.
Proof.
  intros P s [d Hd]. exists d. split. apply cond_pos.
  intros t Ht. apply Hd. 2: lra.
  change (Rabs (t - s) < d). rewrite Rabs_pos_eq; lra.
Qed.

Lemma at_right_intro : forall (P : R -> Prop) s d,
  0 < d -> (forall t, s < t < s + d -> P t) -> at_right s P.
Proof.
  intros P s d Hd HP. exists (mkposreal d Hd). intros t Ht Hs. apply HP.
  change (Rabs (t - s) < d) in Ht. apply Rabs_def2 in Ht. lra.
Qed.

Lemma at_left_intro : forall (P : R -> Prop) s d,
  0 < d -> (forall t, s - d < t < s -> P t) -> at_left s P.
Proof.
  intros P s d Hd HP. exists (mkposreal d Hd). intros t Ht Hs. apply HP.
  change (Rabs (t - s) < d) in Ht. apply Rabs_def2 in Ht. lra.
Qed.

Lemma locally_near : forall (y : R) eps, 0 < eps -> locally y (fun z => Rabs (z - y) < eps).
Proof. intros y eps He. exists (mkposreal eps He). intros z Hz. exact Hz. Qed.

Lemma lim_right_unique : forall (h : R -> R) s y z,
  filterlim h (at_right s) (locally y) -> filterlim h (at_right s) (locally z) -> y = z.
Proof.
  intros h s y z Hy Hz.
  apply (filterlim_locally_unique (F := at_right s) h y z Hy Hz).
Qed.

Lemma lim_left_unique : forall (h : R -> R) s y z,
  filterlim h (at_left s) (locally y) -> filterlim h (at_left s) (locally z) -> y = z.
Proof.
  intros h s y z Hy Hz.
  apply (filterlim_locally_unique (F := at_left s) h y z Hy Hz).
Qed.

Lemma lim_left_le : forall (h : R -> R) s d y, 0 < d ->
  (forall t, s - d < t < s -> h t <= 0) -> filterlim h (at_left s) (locally y) -> y <= 0.
Proof.
  intros h s d y Hd Hh Hl.
  apply (filterlim_le (F := at_left s) h (fun _ => 0) y 0).
  - apply at_left_intro with d; assumption.
  - exact Hl.
  - apply filterlim_const.
Qed.

Lemma lim_left_ge : forall (h : R -> R) s d y, 0 < d ->
  (forall t, s - d < t < s -> 0 <= h t) -> filterlim h (at_left s) (locally y) -> 0 <= y.
Proof.
  intros h s d y Hd Hh Hl.
  apply (filterlim_le (F := at_left s) (fun _ => 0) h 0 y).
  - apply at_left_intro with d; assumption.
  - apply filterlim_const.
  - exact Hl.
Qed.

Lemma lim_right_minus : forall (g h : R -> R) s (y z : R),
  filterlim g (at_right s) (locally y) -> filterlim h (at_right s) (locally z) ->
  filterlim (fun t => minus (g t) (h t)) (at_right s) (locally (minus y z)).
Proof.
  intros g h s y z Hg Hh.
  assert (Ho : filterlim (fun t => opp (h t)) (at_right s) (locally (opp z))).
  { apply filterlim_comp with (1 := Hh). apply (filterlim_opp z). }
  apply (filterlim_comp_2 (F := at_right s) g (fun t => opp (h t)) plus Hg Ho).
  apply (filterlim_plus y (opp z)).
Qed.

(** ** Induction along an interval *)

Lemma real_induction : forall (P : R -> Prop) a b,
  a < b -> P a ->
  (forall s, a <= s < b -> (forall t, a <= t <= s -> P t) ->
     exists d, 0 < d /\ forall t, s < t < s + d -> P t) ->
  (forall s, a < s <= b -> (forall t, a <= t < s -> P t) -> P s) ->
  forall t, a <= t <= b -> P t.
Proof.
  intros P a b Hab Pa Hopen Hclosed.
  set (E := fun s => a <= s <= b /\ forall t, a <= t <= s -> P t).
  assert (Ea : E a).
  { split. lra. intros t Ht. replace t with a by lra. exact Pa. }
  destruct (completeness E) as [m [Hub Hleast]].
  { exists b. intros s [Hs _]. lra. }
  { exists a. exact Ea. }
  assert (Ham : a <= m) by (apply Hub, Ea).
  assert (Hmb : m <= b). { apply Hleast. intros s [Hs _]. lra. }
  assert (Hbelow : forall t, a <= t < m -> P t).
  { intros t Ht.
    destruct (Classical_Prop.classic (exists s, E s /\ t <= s)) as [[s [[Hs Ps] Hts]] | Hno].
    - apply Ps. lra.
    - exfalso. assert (m <= t). 2: lra.
      apply Hleast. intros s Es. destruct (Rle_dec s t) as [H | H]. exact H.
      exfalso. apply Hno. exists s. split. exact Es. lra. }
  assert (Pm : P m).
  { destruct (Req_dec m a) as [-> | Hne]. exact Pa. apply Hclosed. lra. exact Hbelow. }
  assert (Hall : forall t, a <= t <= m -> P t).
  { intros t Ht. destruct (Req_dec t m) as [-> | Hne]. exact Pm. apply Hbelow. lra. }
  destruct (Req_dec m b) as [<- | Hne]. exact Hall.
  exfalso. destruct (Hopen m) as [d [Hd Hafter]]. lra. exact Hall.
  set (s := Rmin b (m + d / 2)).
  assert (Hs1 : s <= b) by apply Rmin_l. assert (Hs2 : s <= m + d / 2) by apply Rmin_r.
  assert (Hs3 : m < s). { apply Rmin_glb_lt; lra. }
  assert (s <= m). 2: lra.
  apply Hub. split. lra. intros t Ht. destruct (Rle_dec t m) as [H | H].
  apply Hall. lra. apply Hafter. lra.
Qed.

(** A function without slope that starts from 0. *)

Lemma stays_zero : forall (h : R -> R) s d, 0 < d ->
  (forall t, s < t < s + d -> is_derive h t 0) ->
  filterlim h (at_right s) (locally 0) -> forall t, s < t < s + d -> h t = 0.
Proof.
  intros h s d Hd Dh Hl t Ht.
  apply (lim_right_unique h s (h t) 0). 2: exact Hl.
  apply filterlim_ext_loc with (fun _ => h t). 2: apply filterlim_const.
  apply at_right_intro with (t - s). lra. intros y Hy.
  destruct (MVT_gen h y t (fun _ => 0)) as [c [_ Hc]].
  - intros z Hz. apply Dh. rewrite Rmin_left in Hz by lra. rewrite Rmax_right in Hz by lra. lra.
  - intros z Hz. rewrite Rmin_left in Hz by lra. rewrite Rmax_right in Hz by lra.
    apply continuity_pt_filterlim. apply (ex_derive_continuous h z). exists 0. apply Dh. lra.
  - lra.
Qed.

(** ** Continuity in terms of one-sided limits *)

Lemma locally_intro : forall (P : R -> Prop) s d,
  0 < d -> (forall t, s - d < t < s + d -> P t) -> locally s P.
Proof.
  intros P s d Hd HP. exists (mkposreal d Hd). intros t Ht. apply HP.
  change (Rabs (t - s) < d) in Ht. apply Rabs_def2 in Ht. lra.
Qed.

Lemma continuous_split : forall (h : R -> R) t,
  filterlim h (at_left t) (locally (h t)) -> filterlim h (at_right t) (locally (h t)) ->
  continuous h t.
Proof.
  intros h t Hl Hr P HP.
  destruct (Hl P HP) as [d1 H1]. destruct (Hr P HP) as [d2 H2].
  assert (Hd : 0 < Rmin d1 d2) by (apply Rmin_glb_lt; apply cond_pos).
  exists (mkposreal _ Hd). intros y Hy.
  assert (D1 := Rmin_l d1 d2). assert (D2 := Rmin_r d1 d2).
  change (Rabs (y - t) < Rmin d1 d2) in Hy.
  destruct (Rtotal_order y t) as [L | [-> | G]].
  - apply H1. 2: exact L. change (Rabs (y - t) < d1). lra.
  - apply locally_singleton, HP.
  - apply H2. 2: exact G. change (Rabs (y - t) < d2). lra.
Qed.
