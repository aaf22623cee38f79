(** * The times of the hits as functions of the state

    The first hit T of the right wall from (a, b) at time 0 solves pos 1 0 a b T = r, and

      dT = - (da + T db) / u,    u = vel 1 0 b T > 0 the speed there;

    the next hit T of the left wall, from the right wall at the time a with the speed b, has

      dT = ((b - (cos a + f) (T - a)) da - (T - a) db) / u.

    The derivatives are functions of T again, wherever these formulas hold: so T is smooth there, by
    induction. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Limits Motion Flight Plane Implicit Smooth.
Open Scope R_scope.

Section Hits.

Variables f l r : R.

Notation vel := (vel f).
Notation pos := (pos f).

(** ** The velocity is Lipschitz *)

Lemma vel_Lipschitz : forall s a b t a' b' t', Rabs s = 1 ->
  Rabs (vel s a' b' t' - vel s a b t) <=
  (1 + Rabs f) * (Rabs (t' - t) + Rabs (a' - a) + Rabs (b' - b)).
Proof.
  intros s a b t a' b' t' Hs. unfold Flight.vel.
  replace (b' + (sin t' - sin a') - s * f * (t' - a') - (b + (sin t - sin a) - s * f * (t - a)))
    with ((b' - b) + (sin t' - sin t) + - (sin a' - sin a) + (s * (- f * (t' - t)) + s * (f * (a' - a))))
    by ring.
  assert (L1 := sin_Lipschitz t' t). assert (L2 := sin_Lipschitz a' a).
  assert (C1 := Rabs_triang (b' - b + (sin t' - sin t) + - (sin a' - sin a))
    (s * (- f * (t' - t)) + s * (f * (a' - a)))).
  assert (C2 := Rabs_triang (s * (- f * (t' - t))) (s * (f * (a' - a)))).
  assert (C3 := Rabs_triang (b' - b + (sin t' - sin t)) (- (sin a' - sin a))).
  assert (C4 := Rabs_triang (b' - b) (sin t' - sin t)).
  rewrite Rabs_Ropp in C3. rewrite !Rabs_mult, Hs in C2. rewrite Rabs_Ropp in C2.
  assert (Q := Rabs_pos f). assert (Q1 := Rabs_pos (t' - t)).
  assert (Q2 := Rabs_pos (a' - a)). assert (Q3 := Rabs_pos (b' - b)). nra.
Qed.

Lemma Lip_pos : 0 < 1 + Rabs f.
Proof. assert (Q := Rabs_pos f). lra. Qed.

Lemma one_or_minus_one : Rabs 1 = 1 /\ Rabs (-1) = 1.
Proof. split. apply Rabs_R1. rewrite Rabs_left; lra. Qed.

(** ** To the right wall *)

Lemma slope1 : forall t a b, is_derive (fun s => pos 1 0 a b s - r) t (vel 1 0 b t).
Proof.
  intros t a b. eapply is_derive_ext with (fun s => minus (pos 1 0 a b s) r). reflexivity.
  replace (vel 1 0 b t) with (minus (vel 1 0 b t) 0) by (unfold minus, plus, opp; simpl; ring).
  apply (is_derive_minus (pos 1 0 a b) (fun _ => r)). apply pos_derive. apply @is_derive_const.
Qed.

Lemma slope1_continuous : forall t a b, continuous_3 (fun t _ b => vel 1 0 b t) t a b.
Proof.
  intros t a b eps He. assert (K := Lip_pos).
  exists (eps / (2 * (1 + Rabs f))). split. apply Rdiv_lt_0_compat; lra.
  intros t' a' b' Ht _ Hb.
  assert (A := vel_Lipschitz 1 0 b t 0 b' t' (proj1 one_or_minus_one)).
  rewrite Rminus_eq_0, Rabs_R0 in A. eapply Rle_lt_trans. exact A.
  replace eps with ((1 + Rabs f) * (2 * (eps / (2 * (1 + Rabs f))))) by (field; lra).
  apply Rmult_lt_compat_l; lra.
Qed.

Lemma slope1_ab : forall t a b, D2 (fun a b => pos 1 0 a b t - r) a b 1 t.
Proof.
  intros t a b. eapply D2_ext.
  eapply (D2_plus (fun a _ => a) (fun _ b => b * t + (pos 1 0 0 0 t - r))).
  apply D2_fst. apply D2_plus. apply D2_mult. apply D2_snd. apply (D2_const t). apply D2_const.
  intros u v. unfold Flight.pos. field. simpl. ring. simpl. ring.
Qed.

Lemma first_hit : forall t x v, 0 < vel 1 0 v t -> pos 1 0 x v t = r ->
  exists H : R -> R -> R, H x v = t /\ smooth H x v /\
  locally_2d (fun a b => pos 1 0 a b (H a b) = r /\ 0 < vel 1 0 b (H a b) /\
    D2 H a b (- 1 / vel 1 0 b (H a b)) (- H a b / vel 1 0 b (H a b))) x v.
Proof.
  intros t x v Forward Hit.
  destruct (implicit_function (fun t a b => pos 1 0 a b t - r) (fun t _ b => vel 1 0 b t)
    (fun _ _ _ => 1) (fun t _ _ => t) slope1 slope1_continuous slope1_ab t x v Forward ltac:(lra))
    as [H [E N]].
  assert (Near : locally_2d (fun a b => pos 1 0 a b (H a b) = r /\ 0 < vel 1 0 b (H a b) /\
    D2 H a b (- 1 / vel 1 0 b (H a b)) (- H a b / vel 1 0 b (H a b))) x v).
  { apply (locally_2d_both _ _ _ _ _ N (locally_2d_twice _ _ _ N)). intros a b [A [B D]] L.
    split. lra. split. exact B.
    apply (implicit_derivative (fun t a b => pos 1 0 a b t - r) (fun t _ b => vel 1 0 b t)
      (fun _ _ _ => 1) (fun t _ _ => t) slope1 slope1_continuous slope1_ab (H a b) a b B A H
      eq_refl). 2: exact D.
    apply (locally_2d_map _ _ _ _ L). intros u w [Q _]. exact Q. }
  exists H. split. exact E. split; [ | exact Near].
  apply (locally_2d_map _ _ _ _ (locally_2d_twice _ _ _ Near)). intros y z Here n.
  induction n as [ | n IH].
  - simpl. apply (locally_2d_map _ _ _ _ Here). intros a b [_ [_ D]]. exact (D2_continuous _ _ _ _ _ D).
  - exists (fun a b => - 1 * / vel 1 0 b (H a b)), (fun a b => (-1) * H a b * / vel 1 0 b (H a b)).
    split. { apply (locally_2d_map _ _ _ _ Here). intros a b [_ [_ D]].
      apply D2_ext with (1 := D). reflexivity. unfold Rdiv. ring. unfold Rdiv. ring. }
    assert (I : cont_diff n (fun a b => / vel 1 0 b (H a b)) y z).
    { destruct (locally_2d_singleton _ _ _ Here) as [_ [Moving _]]. apply cont_diff_inv. lra.
      apply cont_diff_ext with (fun a b => b + (sin (H a b) + (- f) * H a b)).
      apply locally_2d_forall. intros. unfold Flight.vel. rewrite sin_0. ring.
      apply cont_diff_plus. apply cont_diff_snd. apply cont_diff_plus.
      apply cont_diff_sin_cos, IH. apply cont_diff_scal, IH. }
    split. apply cont_diff_scal, I. apply cont_diff_mult. apply cont_diff_scal, IH. exact I.
Qed.

(** ** From the right wall to the left wall *)

(** The distance beyond the left wall. *)

Definition past (t a b : R) : R := l - pos (-1) a r (- b) t.

Lemma slope2 : forall t a b, is_derive (fun s => past s a b) t (- vel (-1) a (- b) t).
Proof.
  intros t a b. unfold past.
  eapply is_derive_ext with (fun s => minus l (pos (-1) a r (- b) s)). reflexivity.
  replace (- vel (-1) a (- b) t) with (minus 0 (vel (-1) a (- b) t))
    by (unfold minus, plus, opp; simpl; ring).
  apply (is_derive_minus (fun _ => l) (pos (-1) a r (- b))). apply @is_derive_const.
  apply pos_derive.
Qed.

Lemma slope2_continuous : forall t a b, continuous_3 (fun t a b => - vel (-1) a (- b) t) t a b.
Proof.
  intros t a b eps He. assert (K := Lip_pos).
  exists (eps / (4 * (1 + Rabs f))). split. apply Rdiv_lt_0_compat; lra.
  intros t' a' b' Ht Ha Hb.
  assert (A := vel_Lipschitz (-1) a (- b) t a' (- b') t' (proj2 one_or_minus_one)).
  replace (- b' - - b) with (- (b' - b)) in A by ring. rewrite Rabs_Ropp in A.
  replace (- vel (-1) a' (- b') t' - - vel (-1) a (- b) t)
    with (- (vel (-1) a' (- b') t' - vel (-1) a (- b) t)) by ring.
  rewrite Rabs_Ropp. eapply Rle_lt_trans. exact A.
  assert (P : 0 < eps / (4 * (1 + Rabs f))) by (apply Rdiv_lt_0_compat; lra).
  replace eps with ((1 + Rabs f) * (4 * (eps / (4 * (1 + Rabs f))))) by (field; lra).
  apply Rmult_lt_compat_l; lra.
Qed.

Lemma slope2_ab : forall t a b, D2 (past t) a b ((cos a + f) * (t - a) - b) (t - a).
Proof.
  intros t a b.
  eapply D2_ext with (f := fun a b => (b * (t + - a)) +
     ((l - r + cos t) + (- cos a + (sin a * (t + - a) + (- f / 2) * ((t + - a) * (t + - a)))))).
  - apply D2_plus.
    + apply D2_mult. apply D2_snd. apply D2_plus. apply D2_const.
      apply (D2_apply Ropp (fun a _ => a) a b (-1)). auto_derive. exact I. ring. apply D2_fst.
    + apply D2_plus. apply D2_const. apply D2_plus.
      apply (D2_apply (fun z => - cos z) (fun a _ => a) a b (sin a)). auto_derive. exact I. ring.
      apply D2_fst.
      apply (D2_apply (fun z => sin z * (t + - z) + (- f / 2) * ((t + - z) * (t + - z)))
               (fun a _ => a) a b (cos a * (t - a) - sin a + f * (t - a))).
      auto_derive. exact I. field. apply D2_fst.
  - intros u v. unfold past, Flight.pos. field.
  - simpl. ring.
  - simpl. ring.
Qed.

Lemma second_hit : forall t t1 u1, 0 < - vel (-1) t1 (- u1) t -> pos (-1) t1 r (- u1) t = l ->
  exists H : R -> R -> R, H t1 u1 = t /\ smooth H t1 u1 /\
  locally_2d (fun a b => pos (-1) a r (- b) (H a b) = l /\ 0 < - vel (-1) a (- b) (H a b) /\
    D2 H a b ((b - (cos a + f) * (H a b - a)) / - vel (-1) a (- b) (H a b))
             (- (H a b - a) / - vel (-1) a (- b) (H a b))) t1 u1.
Proof.
  intros t t1 u1 Forward Hit.
  destruct (implicit_function past (fun t a b => - vel (-1) a (- b) t)
    (fun t a b => (cos a + f) * (t - a) - b) (fun t a _ => t - a) slope2 slope2_continuous slope2_ab
    t t1 u1 Forward ltac:(unfold past; lra)) as [H [E N]].
  assert (Near : locally_2d (fun a b => pos (-1) a r (- b) (H a b) = l /\
    0 < - vel (-1) a (- b) (H a b) /\
    D2 H a b ((b - (cos a + f) * (H a b - a)) / - vel (-1) a (- b) (H a b))
             (- (H a b - a) / - vel (-1) a (- b) (H a b))) t1 u1).
  { apply (locally_2d_both _ _ _ _ _ N (locally_2d_twice _ _ _ N)). intros a b [A [B D]] L.
    split. unfold past in A. lra. split. exact B.
    eapply D2_ext. apply (implicit_derivative past (fun t a b => - vel (-1) a (- b) t)
      (fun t a b => (cos a + f) * (t - a) - b) (fun t a _ => t - a) slope2 slope2_continuous
      slope2_ab (H a b) a b B A H eq_refl). 2: exact D.
    apply (locally_2d_map _ _ _ _ L). intros u w [Q _]. exact Q.
    reflexivity. unfold Rdiv. ring. reflexivity. }
  exists H. split. exact E. split; [ | exact Near].
  apply (locally_2d_map _ _ _ _ (locally_2d_twice _ _ _ Near)). intros y z Here n.
  induction n as [ | n IH].
  - simpl. apply (locally_2d_map _ _ _ _ Here). intros a b [_ [_ D]]. exact (D2_continuous _ _ _ _ _ D).
  - exists (fun a b => (b + (-1) * ((cos a + f) * (H a b + (-1) * a))) * / - vel (-1) a (- b) (H a b)),
           (fun a b => (-1) * (H a b + (-1) * a) * / - vel (-1) a (- b) (H a b)).
    split. { apply (locally_2d_map _ _ _ _ Here). intros a b [_ [_ D]].
      apply D2_ext with (1 := D). reflexivity. unfold Rdiv. f_equal. ring. unfold Rdiv. f_equal. ring. }
    assert (Fst := cont_diff_fst n y z). assert (Snd := cont_diff_snd n y z).
    destruct (cont_diff_sin_cos n _ _ _ Fst) as [Sin Cos].
    destruct (cont_diff_sin_cos n _ _ _ IH) as [Sin' _].
    assert (D : cont_diff n (fun a b => H a b + (-1) * a) y z).
    { apply cont_diff_plus. exact IH. apply cont_diff_scal, Fst. }
    assert (I : cont_diff n (fun a b => / - vel (-1) a (- b) (H a b)) y z).
    { destruct (locally_2d_singleton _ _ _ Here) as [_ [Moving _]]. apply cont_diff_inv. lra.
      apply cont_diff_ext with
        (fun a b => b + (((-1) * sin (H a b) + sin a) + (- f) * (H a b + (-1) * a))).
      apply locally_2d_forall. intros. unfold Flight.vel. ring.
      apply cont_diff_plus. exact Snd. apply cont_diff_plus. apply cont_diff_plus.
      apply cont_diff_scal, Sin'. exact Sin. apply cont_diff_scal, D. }
    split; apply cont_diff_mult; try exact I.
    + apply cont_diff_plus. exact Snd. apply cont_diff_scal, cont_diff_mult. 2: exact D.
      apply cont_diff_plus. exact Cos. apply cont_diff_const.
    + apply cont_diff_scal, D.
Qed.

End Hits.
