(** * The map of the period near an orbit: smooth, with an explicit derivative, area-preserving

    Around a state (x, v) that [passes] there are functions H, G of the state, the hit times, and the
    map is X = end_x, V = end_v.  Its derivative is the product C B A of three matrices:

      A: (x, v) -> (time, speed) at the right wall,   B: -> at the left wall,   C: -> (x, v) at 2 pi,

    of determinants - 1/u1, u1/u2 and - u2, u1 and u2 the speeds at the hits. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Limits Motion Flight Plane Smooth Hits Image.
Open Scope R_scope.

Section Strobe.

Variables f l r : R.
Hypothesis walls : l < r.

Notation vel := (vel f).
Notation pos := (pos f).
Notation T := (2 * PI).
Notation after1 := (after1 f).
Notation after2 := (after2 f).
Notation end_x := (end_x f l).
Notation end_v := (end_v f).
Notation passes := (passes f l r).

(** ** The matrices *)

Section Matrices.

Variables v t1 t2 : R.
Let u1 := after1 v t1.
Let u2 := after2 v t1 t2.

Definition a11 := - 1 / u1.
Definition a12 := - t1 / u1.
Definition a21 := (cos t1 - f) * a11.
Definition a22 := 1 + (cos t1 - f) * a12.

Definition b11 := (u1 - (cos t1 + f) * (t2 - t1)) / u2.
Definition b12 := - (t2 - t1) / u2.
Definition b21 := cos t1 + f - (cos t2 + f) * b11.
Definition b22 := 1 - (cos t2 + f) * b12.

Definition d11 := (f - cos t2) * (T - t2) - u2.
Definition d12 := T - t2.
Definition d21 := f - cos t2.
Definition d22 := 1.

Definition ba11 := b11 * a11 + b12 * a21.
Definition ba12 := b11 * a12 + b12 * a22.
Definition ba21 := b21 * a11 + b22 * a21.
Definition ba22 := b21 * a12 + b22 * a22.

Definition m11 := d11 * ba11 + d12 * ba21.
Definition m12 := d11 * ba12 + d12 * ba22.
Definition m21 := d21 * ba11 + d22 * ba21.
Definition m22 := d21 * ba12 + d22 * ba22.

Lemma determinant : u1 <> 0 -> u2 <> 0 -> m11 * m22 - m12 * m21 = 1.
Proof.
  intros H1 H2. unfold m11, m12, m21, m22, ba11, ba12, ba21, ba22.
  assert (A : a11 * a22 - a12 * a21 = - 1 / u1).
  { unfold a21, a22, a11, a12. field. exact H1. }
  assert (B : b11 * b22 - b12 * b21 = u1 / u2).
  { unfold b21, b22, b11, b12. field. exact H2. }
  assert (D : d11 * d22 - d12 * d21 = - u2).
  { unfold d11, d12, d21, d22. ring. }
  replace 1 with ((d11 * d22 - d12 * d21) * ((b11 * b22 - b12 * b21) * (a11 * a22 - a12 * a21)))
    by (rewrite A, B, D; field; auto).
  ring.
Qed.

End Matrices.

(** ** The last flight *)

Lemma final_ab : forall a b,
  D2 (fun a b => pos 1 a l b T) a b ((f - cos a) * (T - a) - b) (T - a) /\
  D2 (fun a b => vel 1 a b T) a b (f - cos a) 1.
Proof.
  intros a b. split.
  - eapply D2_ext with (f := fun a b => (b * (T + - a)) +
      ((l - cos T) + (cos a - sin a * (T + - a) - (f / 2) * ((T + - a) * (T + - a))))).
    + apply D2_plus.
      * apply D2_mult. apply D2_snd.
        apply (D2_apply (fun a => T + - a) (fun a _ => a) a b (-1)). auto_derive. exact I. ring.
        apply D2_fst.
      * apply D2_plus. apply D2_const.
        apply (D2_apply (fun z => cos z - sin z * (T + - z) - (f / 2) * ((T + - z) * (T + - z)))
                 (fun a _ => a) a b (- cos a * (T - a) + f * (T - a))).
        auto_derive. exact I. field. apply D2_fst.
    + intros u w. unfold Flight.pos. field.
    + simpl. ring.
    + simpl. ring.
  - eapply D2_ext with (f := fun a b => b + (sin T - sin a - f * (T - a))).
    + apply D2_plus. apply D2_snd.
      apply (D2_apply (fun a => sin T - sin a - f * (T - a)) (fun a _ => a) a b (f - cos a)).
      auto_derive. exact I. ring. apply D2_fst.
    + intros u w. unfold Flight.vel. ring.
    + simpl. ring.
    + simpl. ring.
Qed.

Lemma final_smooth : forall n (G W : R -> R -> R) x v, cont_diff n G x v -> cont_diff n W x v ->
  cont_diff n (fun a b => pos 1 (G a b) l (W a b) T) x v /\
  cont_diff n (fun a b => vel 1 (G a b) (W a b) T) x v.
Proof.
  intros n G W x v HG HW. destruct (cont_diff_sin_cos n _ _ _ HG) as [Sin Cos].
  assert (D : cont_diff n (fun a b => T + (-1) * G a b) x v).
  { apply cont_diff_plus. apply cont_diff_const. apply cont_diff_scal, HG. }
  split.
  - apply cont_diff_ext with (fun a b => (l - cos T) + (cos (G a b) + (W a b * (T + (-1) * G a b) +
      ((-1) * (sin (G a b) * (T + (-1) * G a b)) +
       (- f / 2) * ((T + (-1) * G a b) * (T + (-1) * G a b)))))).
    { apply locally_2d_forall. intros. unfold Flight.pos. field. }
    apply cont_diff_plus. apply cont_diff_const. apply cont_diff_plus. exact Cos.
    apply cont_diff_plus. apply cont_diff_mult; assumption. apply cont_diff_plus.
    apply cont_diff_scal, cont_diff_mult; assumption.
    apply cont_diff_scal, cont_diff_mult; assumption.
  - apply cont_diff_ext with (fun a b => W a b + (sin T + ((-1) * sin (G a b) +
      (- f) * (T + (-1) * G a b)))).
    { apply locally_2d_forall. intros. unfold Flight.vel. ring. }
    apply cont_diff_plus. exact HW. apply cont_diff_plus. apply cont_diff_const.
    apply cont_diff_plus. apply cont_diff_scal, Sin. apply cont_diff_scal, D.
Qed.

(** ** The map *)

Section Map.

Variables x v t1 t2 : R.
Hypothesis orbit : passes x v t1 t2.

(** The hit times H, G and the speeds at them, as functions of the state. *)

Record hits (H G : R -> R -> R) : Prop := {
  h_first : H x v = t1;
  h_second : G x v = t2;
  h_passes : locally_2d (fun a b => passes a b (H a b) (G a b)) x v;
  h_smooth_H : smooth H x v;
  h_smooth_U : smooth (fun a b => after1 b (H a b)) x v;
  h_smooth_G : smooth G x v;
  h_smooth_W : smooth (fun a b => after2 b (H a b) (G a b)) x v;
  h_derivative : locally_2d (fun a b =>
    D2 (fun a b => end_x b (H a b) (G a b)) a b (m11 b (H a b) (G a b)) (m12 b (H a b) (G a b)) /\
    D2 (fun a b => end_v b (H a b) (G a b)) a b (m21 b (H a b) (G a b)) (m22 b (H a b) (G a b))) x v
}.

Lemma smooth_D2 : forall h, smooth h x v -> continuity_2d_pt h x v.
Proof. intros h S. exact (locally_2d_singleton _ _ _ (smooth_here _ _ _ S 0%nat)). Qed.

Theorem hits_exist : exists H G, hits H G.
Proof.
  destruct (passes_speeds f l r x v t1 t2 orbit) as [U1 U2].
  destruct (first_hit f r t1 x v U1 (p_right _ _ _ _ _ _ _ orbit)) as [H [E1 [SH N1]]].
  destruct (second_hit f l r t2 t1 (after1 v t1) U2 (p_left _ _ _ _ _ _ _ orbit))
    as [H2 [E2 [SH2 N2]]].
  set (U := fun a b => after1 b (H a b)).
  assert (EU : U x v = after1 v t1) by (unfold U; rewrite E1; reflexivity).
  assert (SU : smooth U x v).
  { apply (locally_2d_map _ _ _ _ SH). intros y z CH n.
    apply cont_diff_ext with (fun a b => b + (sin (H a b) + (- f) * H a b)).
    apply locally_2d_forall. intros. unfold U, Image.after1, Flight.vel. rewrite sin_0. ring.
    apply cont_diff_plus. apply cont_diff_snd. apply cont_diff_plus.
    apply cont_diff_sin_cos, CH. apply cont_diff_scal, CH. }
  set (G := fun a b => H2 (H a b) (U a b)).
  assert (EG : G x v = t2) by (unfold G; rewrite E1, EU; exact E2).
  assert (SG : smooth G x v).
  { apply (smooth_comp H2 H U). rewrite E1, EU. exact SH2. exact SH. exact SU. }
  set (W := fun a b => after2 b (H a b) (G a b)).
  assert (SW : smooth W x v).
  { apply (locally_2d_both _ _ _ _ _ (locally_2d_and _ _ _ _ SH SU) SG). intros y z [CH CU] CG n.
    destruct (cont_diff_sin_cos n _ _ _ (CH n)) as [Sin _].
    destruct (cont_diff_sin_cos n _ _ _ (CG n)) as [Sin' _].
    apply cont_diff_ext with (fun a b => U a b + ((sin (H a b) + f * H a b) +
      ((-1) * sin (G a b) + (- f) * G a b))).
    apply locally_2d_forall. intros. unfold W, Image.after2, U, Flight.vel. ring.
    apply cont_diff_plus. apply CU. apply cont_diff_plus. apply cont_diff_plus. exact Sin.
    apply cont_diff_scal, CH. apply cont_diff_plus. apply cont_diff_scal, Sin'.
    apply cont_diff_scal, CG. }
  assert (N2' : locally_2d (fun a b => pos (-1) (H a b) r (- U a b) (G a b) = l /\
      0 < - vel (-1) (H a b) (- U a b) (G a b) /\
      D2 H2 (H a b) (U a b)
        ((U a b - (cos (H a b) + f) * (G a b - H a b)) / - vel (-1) (H a b) (- U a b) (G a b))
        (- (G a b - H a b) / - vel (-1) (H a b) (- U a b) (G a b))) x v).
  { apply (locally_2d_comp (fun a b => pos (-1) a r (- b) (H2 a b) = l /\
      0 < - vel (-1) a (- b) (H2 a b) /\
      D2 H2 a b ((b - (cos a + f) * (H2 a b - a)) / - vel (-1) a (- b) (H2 a b))
             (- (H2 a b - a) / - vel (-1) a (- b) (H2 a b))) H U x v).
    rewrite E1, EU. exact N2. apply smooth_D2, SH. apply smooth_D2, SU. }
  assert (CX := final_smooth 0 G W x v (smooth_here _ _ _ SG _) (smooth_here _ _ _ SW _)).
  exists H, G. split; auto.
  - apply passes_open.
    + rewrite E1, EG. exact orbit.
    + apply smooth_D2, SH.
    + apply smooth_D2, SG.
    + apply (smooth_D2 U), SU.
    + apply (smooth_D2 W), SW.
    + exact (locally_2d_singleton _ _ _ (proj1 CX)).
    + apply (locally_2d_map _ _ _ _ N1). intros a b [Q _]. exact Q.
    + apply (locally_2d_map _ _ _ _ N2'). intros a b [Q _]. exact Q.
  - apply (locally_2d_both _ _ _ _ _ N1 N2'). intros a b (R1 & P1 & D1) (R2 & P2 & D2').
    assert (DU : D2 U a b (a21 b (H a b)) (a22 b (H a b))).
    { eapply D2_ext with (f := fun a b => b + (sin (H a b) - sin 0 - f * H a b)).
      - apply D2_plus. apply D2_snd.
        apply (D2_apply (fun z => sin z - sin 0 - f * z) H a b (cos (H a b) - f)).
        auto_derive. exact I. ring. exact D1.
      - intros p q. unfold U, Image.after1, Flight.vel. ring.
      - unfold a21, a11, Image.after1. ring.
      - unfold a22, a12, Image.after1. ring. }
    assert (DG : D2 G a b (ba11 b (H a b) (G a b)) (ba12 b (H a b) (G a b))).
    { apply (differentiable_pt_lim_comp H2 H U); [exact D2' | exact D1 | exact DU]. }
    assert (DW : D2 W a b (ba21 b (H a b) (G a b)) (ba22 b (H a b) (G a b))).
    { eapply D2_ext with (f := fun a b => U a b + ((sin (H a b) + f * H a b) +
        (- sin (G a b) - f * G a b))).
      - apply D2_plus. exact DU. apply D2_plus.
        apply (D2_apply (fun z => sin z + f * z) H a b (cos (H a b) + f)).
        auto_derive. exact I. ring. exact D1.
        apply (D2_apply (fun z => - sin z - f * z) G a b (- cos (G a b) - f)).
        auto_derive. exact I. ring. exact DG.
      - intros p q. unfold W, Image.after2, U, Flight.vel. ring.
      - unfold ba21, ba11, b21, b22, a21, a11, Image.after1. ring.
      - unfold ba22, ba12, b21, b22, a22, a12, Image.after1. ring. }
    destruct (final_ab (G a b) (W a b)) as [DX DV]. split.
    + apply (differentiable_pt_lim_comp (fun a b => pos 1 a l b T) G W); assumption.
    + apply (differentiable_pt_lim_comp (fun a b => vel 1 a b T) G W); assumption.
Qed.

(** What this says of the map. *)

Section Consequences.

Variables H G : R -> R -> R.
Hypothesis HG : hits H G.
Let X (a b : R) := end_x b (H a b) (G a b).
Let V (a b : R) := end_v b (H a b) (G a b).

Theorem map_image : locally_2d (fun a b => image 1 1 f l r 1 a b (X a b) (V a b)) x v.
Proof.
  apply (locally_2d_map _ _ _ _ (h_passes _ _ HG)). intros a b. apply passes_image, walls.
Qed.

Theorem map_smooth : smooth X x v /\ smooth V x v.
Proof.
  split; apply (locally_2d_both _ _ _ _ _ (h_smooth_G _ _ HG) (h_smooth_W _ _ HG));
    intros y z SG SW n; apply (final_smooth n G (fun a b => after2 b (H a b) (G a b))); auto.
Qed.

Theorem map_area : preserves_area X V x v.
Proof.
  apply (locally_2d_both _ _ _ _ _ (h_passes _ _ HG) (h_derivative _ _ HG)). intros a b P [DX DV].
  destruct (passes_speeds _ _ _ _ _ _ _ P) as [U1 U2].
  exists (m11 b (H a b) (G a b)), (m12 b (H a b) (G a b)),
         (m21 b (H a b) (G a b)), (m22 b (H a b) (G a b)).
  split. exact DX. split. exact DV. apply determinant; lra.
Qed.

End Consequences.

End Map.

End Strobe.
