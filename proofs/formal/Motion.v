(** * A motion that never stops is the only one from its state, among all motions

    While v is not 0 its sign stays, x is off the walls right after every instant, and x'' is a
    function of t alone: two motions with the same state at s agree on some (s, s + d).  If they
    agree before s they agree at s: x is continuous, and v jumps by a law.  So they agree. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Limits.
Open Scope R_scope.

Section Motion.

Variables F w f l r e : R.
Hypothesis walls : l < r.

Notation laws := (laws F w f l r e).
Notation motion := (motion F w f l r e).

(** ** Right after a time *)

Lemma right_continuous : forall a b x v s, motion a b x v -> 0 < e -> a <= s < b ->
  l <= x s <= r /\
  filterlim x (at_right s) (locally (x s)) /\ filterlim v (at_right s) (locally (v s)) /\
  (v s < 0 -> l < x s) /\ (0 < v s -> x s < r).
Proof.
  intros a b x v s M He Hs.
  destruct (Req_dec s a) as [-> | Hne].
  { destruct M as [_ H _ Hx Hv _ _].
    split; [lra | split; [exact Hx | split; [exact Hv | split; intros; lra]]]. }
  destruct (m_laws _ _ _ _ _ _ _ _ _ _ M s) as [Hin [Hfree [Hr Hl]]]. lra.
  split. exact Hin.
  destruct (Req_dec (x s) r) as [Er | Nr].
  { destruct (Hr Er) as [Cx [u [Hu [_ [Ev Hv]]]]].
    split. apply at_right_of_continuous, Cx. split. exact Hv. split.
    intros. lra. intros H. exfalso. rewrite Ev in H. nra. }
  destruct (Req_dec (x s) l) as [El | Nl].
  { destruct (Hl El) as [Cx [u [Hu [_ [Ev Hv]]]]].
    split. apply at_right_of_continuous, Cx. split. exact Hv. split.
    intros H. exfalso. rewrite Ev in H. nra. intros. lra. }
  destruct Hfree as [Dx [Cv _]]. lra.
  split. apply at_right_of_continuous. apply (ex_derive_continuous x s). exists (v s). exact Dx.
  split. apply at_right_of_continuous, Cv. split; intros; lra.
Qed.

Lemma soon_free : forall a b x v s, motion a b x v -> 0 < e -> a <= s < b -> v s <> 0 ->
  exists d, 0 < d /\ forall t, s < t < s + d ->
    t < b /\ l < x t < r /\ v t <> 0 /\ sign (v t) = sign (v s).
Proof.
  intros a b x v s M He Hs Hvs.
  destruct (right_continuous a b x v s M He Hs) as [Hin [Hx [Hv [Hneg Hpos]]]].
  assert (Pv : at_right s (fun t => Rabs (v t - v s) < Rabs (v s))).
  { apply (Hv (fun y => Rabs (y - v s) < Rabs (v s))). apply locally_near, Rabs_pos_lt, Hvs. }
  apply at_right_elim in Pv. destruct Pv as [d1 [Hd1 Pv]].
  destruct (Rdichotomy _ _ Hvs) as [Hv0 | Hv0].
  - specialize (Hneg Hv0).
    assert (Px : at_right s (fun t => Rabs (x t - x s) < x s - l)).
    { apply (Hx (fun y => Rabs (y - x s) < x s - l)). apply locally_near. lra. }
    apply at_right_elim in Px. destruct Px as [d2 [Hd2 Px]].
    set (d := Rmin (b - s) (Rmin d1 d2)).
    assert (D0 : d <= b - s) by apply Rmin_l.
    assert (D1 : d <= d1). { eapply Rle_trans. apply Rmin_r. apply Rmin_l. }
    assert (D2 : d <= d2). { eapply Rle_trans. apply Rmin_r. apply Rmin_r. }
    assert (D3 : 0 < d). { repeat apply Rmin_glb_lt; lra. }
    assert (Vneg : forall t, s < t < s + d -> v t < 0).
    { intros t Ht. assert (H := Pv t ltac:(lra)). rewrite (Rabs_left (v s)) in H by lra.
      apply Rabs_def2 in H. lra. }
    exists d. split. exact D3. intros t Ht.
    assert (Hvt := Vneg t Ht).
    split. lra. split.
    { assert (H := Px t ltac:(lra)). apply Rabs_def2 in H.
      destruct (m_laws _ _ _ _ _ _ _ _ _ _ M t) as [Hin' [_ [Hr _]]]. lra.
      split. lra. destruct (Req_dec (x t) r) as [Er | Nr]. 2: lra.
      exfalso. destruct (Hr Er) as [_ [u [Hu [Hlim [Ev _]]]]].
      assert (u <= 0).
      { apply (lim_left_le v t (t - s) u). lra.
        intros y Hy. left. apply Vneg. lra. exact Hlim. }
      assert (u = 0) by lra. subst u. rewrite Ev in Hvt. lra. }
    split. lra. rewrite !sign_eq_m1; auto.
  - specialize (Hpos Hv0).
    assert (Px : at_right s (fun t => Rabs (x t - x s) < r - x s)).
    { apply (Hx (fun y => Rabs (y - x s) < r - x s)). apply locally_near. lra. }
    apply at_right_elim in Px. destruct Px as [d2 [Hd2 Px]].
    set (d := Rmin (b - s) (Rmin d1 d2)).
    assert (D0 : d <= b - s) by apply Rmin_l.
    assert (D1 : d <= d1). { eapply Rle_trans. apply Rmin_r. apply Rmin_l. }
    assert (D2 : d <= d2). { eapply Rle_trans. apply Rmin_r. apply Rmin_r. }
    assert (D3 : 0 < d). { repeat apply Rmin_glb_lt; lra. }
    assert (Vpos : forall t, s < t < s + d -> 0 < v t).
    { intros t Ht. assert (H := Pv t ltac:(lra)). rewrite (Rabs_right (v s)) in H by lra.
      apply Rabs_def2 in H. lra. }
    exists d. split. exact D3. intros t Ht.
    assert (Hvt := Vpos t Ht).
    split. lra. split.
    { assert (H := Px t ltac:(lra)). apply Rabs_def2 in H.
      destruct (m_laws _ _ _ _ _ _ _ _ _ _ M t) as [Hin' [_ [_ Hl]]]. lra.
      split. 2: lra. destruct (Req_dec (x t) l) as [El | Nl]. 2: lra.
      exfalso. destruct (Hl El) as [_ [u [Hu [Hlim [Ev _]]]]].
      assert (0 <= u).
      { apply (lim_left_ge v t (t - s) u). lra.
        intros y Hy. left. apply Vpos. lra. exact Hlim. }
      assert (u = 0) by lra. subst u. rewrite Ev in Hvt. lra. }
    split. lra. rewrite !sign_eq_1; auto.
Qed.

(** ** Uniqueness *)

Theorem motion_unique : forall a b x v y z, 0 < e -> a < b ->
  motion a b x v -> never_stops a b v -> motion a b y z -> y a = x a -> z a = v a ->
  forall t, a <= t <= b -> y t = x t /\ z t = v t.
Proof.
  intros a b x v y z He Hab M Hns N E0 E1.
  apply real_induction. exact Hab. split; assumption.
  - intros s Hs Hbefore. destruct (Hbefore s ltac:(lra)) as [Ey Ez].
    assert (Hvs : v s <> 0) by (apply Hns; lra).
    destruct (soon_free a b x v s M He Hs Hvs) as [d1 [Hd1 Fx]].
    destruct (soon_free a b y z s N He Hs) as [d2 [Hd2 Fy]]. rewrite Ez. exact Hvs.
    destruct (right_continuous a b x v s M He Hs) as [_ [Lx [Lv _]]].
    destruct (right_continuous a b y z s N He Hs) as [_ [Ly [Lz _]]].
    set (d := Rmin d1 d2).
    assert (D1 : d <= d1) by apply Rmin_l. assert (D2 : d <= d2) by apply Rmin_r.
    assert (D3 : 0 < d) by (apply Rmin_glb_lt; lra).
    assert (Hz : forall t, s < t < s + d -> minus (z t) (v t) = 0).
    { apply (stays_zero (fun t => minus (z t) (v t)) s d D3).
      - intros t Ht.
        destruct (Fx t ltac:(lra)) as [Hb [Hin [Hv Hsg]]].
        destruct (Fy t ltac:(lra)) as [_ [Hin' [Hv' Hsg']]].
        destruct (m_laws _ _ _ _ _ _ _ _ _ _ M t) as [_ [H _]]. lra. destruct (H Hin) as [_ [_ A]].
        destruct (m_laws _ _ _ _ _ _ _ _ _ _ N t) as [_ [H' _]]. lra. destruct (H' Hin') as [_ [_ B]].
        specialize (A Hv). specialize (B Hv').
        rewrite Hsg' in B. rewrite Hsg in A. rewrite Ez in B.
        replace 0 with (minus (F * cos (w * t) - f * sign (v s)) (F * cos (w * t) - f * sign (v s)))
          by (unfold minus, plus, opp; simpl; ring).
        apply (is_derive_minus z v t); assumption.
      - replace 0 with (minus (z s) (v s)) by (rewrite Ez; unfold minus, plus, opp; simpl; ring).
        apply lim_right_minus; assumption. }
    assert (Hzv : forall t, s < t < s + d -> z t = v t).
    { intros t Ht. assert (H := Hz t Ht). unfold minus, plus, opp in H. simpl in H. lra. }
    assert (Hy : forall t, s < t < s + d -> minus (y t) (x t) = 0).
    { apply (stays_zero (fun t => minus (y t) (x t)) s d D3).
      - intros t Ht.
        destruct (Fx t ltac:(lra)) as [Hb [Hin [Hv Hsg]]].
        destruct (Fy t ltac:(lra)) as [_ [Hin' [Hv' Hsg']]].
        destruct (m_laws _ _ _ _ _ _ _ _ _ _ M t) as [_ [H _]]. lra. destruct (H Hin) as [A _].
        destruct (m_laws _ _ _ _ _ _ _ _ _ _ N t) as [_ [H' _]]. lra. destruct (H' Hin') as [B _].
        replace 0 with (minus (z t) (v t))
          by (rewrite (Hzv t Ht); unfold minus, plus, opp; simpl; ring).
        apply (is_derive_minus y x t); assumption.
      - replace 0 with (minus (y s) (x s)) by (rewrite Ey; unfold minus, plus, opp; simpl; ring).
        apply lim_right_minus; assumption. }
    exists d. split. exact D3. intros t Ht. split. 2: apply Hzv, Ht.
    assert (H := Hy t Ht). unfold minus, plus, opp in H. simpl in H. lra.
  - intros s Hs Hbefore.
    assert (Ay : forall h, filterlim x (at_left s) (locally h) -> filterlim y (at_left s) (locally h)).
    { intros h. apply filterlim_ext_loc. apply at_left_intro with (s - a). lra.
      intros t Ht. symmetry. apply Hbefore. lra. }
    assert (Az : forall h, filterlim v (at_left s) (locally h) -> filterlim z (at_left s) (locally h)).
    { intros h. apply filterlim_ext_loc. apply at_left_intro with (s - a). lra.
      intros t Ht. symmetry. apply Hbefore. lra. }
    destruct (Req_dec s b) as [-> | Hne].
    + split.
      * apply (lim_left_unique y b). apply (m_stop_x _ _ _ _ _ _ _ _ _ _ N). apply Ay, (m_stop_x _ _ _ _ _ _ _ _ _ _ M).
      * apply (lim_left_unique z b). apply (m_stop_v _ _ _ _ _ _ _ _ _ _ N). apply Az, (m_stop_v _ _ _ _ _ _ _ _ _ _ M).
    + destruct (m_laws _ _ _ _ _ _ _ _ _ _ M s) as [Hin [Hf [Hr Hl]]]. lra.
      destruct (m_laws _ _ _ _ _ _ _ _ _ _ N s) as [Hin' [Hf' [Hr' Hl']]]. lra.
      assert (Cx : continuous x s).
      { destruct (Req_dec (x s) r). apply Hr; assumption.
        destruct (Req_dec (x s) l). apply Hl; assumption.
        apply (ex_derive_continuous x s). exists (v s). apply Hf. lra. }
      assert (Cy : continuous y s).
      { destruct (Req_dec (y s) r). apply Hr'; assumption.
        destruct (Req_dec (y s) l). apply Hl'; assumption.
        apply (ex_derive_continuous y s). exists (z s). apply Hf'. lra. }
      assert (Eyx : y s = x s).
      { apply (lim_left_unique y s). apply at_left_of_continuous, Cy.
        apply Ay, at_left_of_continuous, Cx. }
      split. exact Eyx.
      destruct (Req_dec (x s) r) as [Er | Nr].
      { destruct (Hr Er) as [_ [u [_ [L1 [E _]]]]].
        destruct (Hr' ltac:(lra)) as [_ [u' [_ [L2 [E' _]]]]].
        rewrite E, E'. f_equal. apply (lim_left_unique z s). exact L2. apply Az, L1. }
      destruct (Req_dec (x s) l) as [El | Nl].
      { destruct (Hl El) as [_ [u [_ [L1 [E _]]]]].
        destruct (Hl' ltac:(lra)) as [_ [u' [_ [L2 [E' _]]]]].
        rewrite E, E'. f_equal. apply (lim_left_unique z s). exact L2. apply Az, L1. }
      destruct (Hf ltac:(lra)) as [_ [Cv _]]. destruct (Hf' ltac:(lra)) as [_ [Cz _]].
      apply (lim_left_unique z s). apply at_left_of_continuous, Cz.
      apply Az, at_left_of_continuous, Cv.
Qed.

End Motion.
