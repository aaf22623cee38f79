(** * Taylor polynomials: they are unique, and can be integrated

    If the derivatives of F are p + O(n) and q + O(n), n <= 3, then F is a polynomial + O(n + 1): go
    from 0 to (a, 0) and on to (a, b).  So a function that is n times continuously differentiable,
    n <= 4, has a Taylor polynomial; and since the way over (0, b) gives the same polynomial, those of
    the derivatives are the derivatives of it. *)

From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Plane Smooth Order Jet.
Open Scope R_scope.

(** ** Uniqueness *)

Lemma small_const : forall c M d, 0 < d -> (forall s, 0 < s < d -> Rabs c <= M * s) -> c = 0.
Proof.
  intros c M d Hd H. destruct (Req_dec c 0) as [E | N]. exact E. exfalso.
  assert (P := Rabs_pos_lt _ N). assert (Q := Rabs_pos M). assert (A := Rle_abs M).
  set (s := Rmin (d / 2) (Rabs c / (2 * (Rabs M + 1)))).
  assert (S1 : s <= d / 2) by apply Rmin_l.
  assert (S2 : s <= Rabs c / (2 * (Rabs M + 1))) by apply Rmin_r.
  assert (S0 : 0 < s) by (apply Rmin_glb_lt; [lra | apply Rdiv_lt_0_compat; lra]).
  assert (B := H s ltac:(lra)).
  assert (E : (Rabs M + 1) * (Rabs c / (2 * (Rabs M + 1))) = Rabs c / 2) by (field; lra).
  nra.
Qed.

(** A constant plus s times something bounded, if it is O(s^(n + 1)). *)

Lemma split_order : forall n k (g : R -> R) M K d, 0 < d -> d <= 1 ->
  (forall s, 0 < s < d -> Rabs (g s) <= M) ->
  (forall s, 0 < s < d -> Rabs (k + s * g s) <= K * s ^ S n) ->
  k = 0 /\ forall s, 0 < s < d -> Rabs (g s) <= K * s ^ n.
Proof.
  intros n k g M K d Hd Hd1 Hg H.
  assert (K0 : k = 0).
  { apply (small_const k (Rabs K + M) d Hd). intros s Hs. assert (Q := H s Hs). simpl in Q.
    assert (P1 : 0 <= s ^ n) by (apply pow_le; lra).
    assert (P2 : s ^ n <= 1) by (rewrite <- (pow1 n); apply pow_incr; lra).
    assert (A := Rle_abs K). assert (A0 := Rabs_pos K). assert (B := Hg s Hs).
    assert (C : K * (s * s ^ n) <= Rabs K * s).
    { apply Rle_trans with (Rabs K * (s * s ^ n)). apply Rmult_le_compat_r; nra.
      apply Rmult_le_compat_l; nra. }
    replace k with ((k + s * g s) - s * g s) by ring. eapply Rle_trans. apply Rabs_triang.
    rewrite Rabs_Ropp, (Rabs_mult s), (Rabs_pos_eq s) by lra. nra. }
  split. exact K0. intros s Hs. assert (Q := H s Hs). subst k. simpl in Q.
  rewrite Rplus_0_l, Rabs_mult, (Rabs_pos_eq s) in Q by lra.
  apply Rmult_le_reg_l with s. lra. lra.
Qed.

Lemma bounded_poly : forall k0 k1 k2 s, 0 < s < 1 ->
  Rabs (k0 + s * (k1 + s * k2)) <= Rabs k0 + (Rabs k1 + Rabs k2).
Proof.
  intros k0 k1 k2 s Hs.
  assert (A0 := Rabs_pos k0). assert (A1 := Rabs_pos k1). assert (A2 := Rabs_pos k2).
  assert (L : forall y z, Rabs (y + s * z) <= Rabs y + Rabs z).
  { intros y z. eapply Rle_trans. apply Rabs_triang. rewrite Rabs_mult, (Rabs_pos_eq s) by lra.
    assert (P := Rabs_pos z). nra. }
  eapply Rle_trans. apply L. assert (Q := L k1 k2). lra.
Qed.

(** A polynomial in one variable that is O(s^n). *)

Lemma small_poly : forall n k0 k1 k2 k3 K d, 0 < d -> d <= 1 ->
  (forall s, 0 < s < d -> Rabs (k0 + s * (k1 + s * (k2 + s * k3))) <= K * s ^ n) ->
  ((1 <= n)%nat -> k0 = 0) /\ ((2 <= n)%nat -> k1 = 0) /\ ((3 <= n)%nat -> k2 = 0) /\
  ((4 <= n)%nat -> k3 = 0).
Proof.
  intros n k0 k1 k2 k3 K d Hd Hd1 H.
  destruct n as [ | n]. repeat split; intros; lia.
  destruct (split_order n k0 _ (Rabs k1 + (Rabs k2 + Rabs k3)) K d Hd Hd1
    (fun s Hs => bounded_poly k1 k2 k3 s ltac:(lra)) H) as [E0 H1].
  split. auto. destruct n as [ | n]. repeat split; intros; lia.
  destruct (split_order n k1 (fun s => k2 + s * k3) (Rabs k2 + (Rabs k3 + Rabs 0)) K d Hd Hd1)
    as [E1 H2]; [ | exact H1 | ].
  { intros s Hs. replace (k2 + s * k3) with (k2 + s * (k3 + s * 0)) by ring.
    apply bounded_poly. lra. }
  split. auto. destruct n as [ | n]. repeat split; intros; lia.
  destruct (split_order n k2 _ (Rabs k3) K d Hd Hd1 (fun s Hs => Rle_refl _) H2) as [E2 H3].
  split. auto. destruct n as [ | n]. intros; lia.
  destruct (split_order n k3 (fun _ => 0) 0 K d Hd Hd1) as [E3 _]; auto.
  intros. rewrite Rabs_R0. lra.
  intros s Hs. replace (k3 + s * 0) with k3 by ring. apply H3, Hs.
Qed.

Lemma ray : forall n j u w, Rabs u <= 1 -> Rabs w <= 1 -> order n (ev j) ->
  ((1 <= n)%nat -> c00 j = 0) /\ ((2 <= n)%nat -> p1 j u w = 0) /\ ((3 <= n)%nat -> p2 j u w = 0) /\
  ((4 <= n)%nat -> p3 j u w = 0).
Proof.
  intros n j u w Hu Hw (K & d & HK & Hd & Hd1 & H).
  apply (small_poly n _ _ _ _ K d Hd Hd1). intros s Hs.
  assert (S : size (s * u) (s * w) <= s).
  { unfold size. rewrite !Rabs_mult, (Rabs_pos_eq s) by lra.
    apply Rmax_lub; assert (A := Rabs_pos u); assert (B := Rabs_pos w); nra. }
  replace (c00 j + s * (p1 j u w + s * (p2 j u w + s * p3 j u w))) with (ev j (s * u) (s * w))
    by (unfold_ev; ring).
  eapply Rle_trans. apply H. lra. apply Rmult_le_compat_l. exact HK.
  apply pow_incr. split. apply size_pos. exact S.
Qed.

Lemma small_jet : forall n j, order n (ev j) ->
  ((1 <= n)%nat -> c00 j = 0) /\ ((2 <= n)%nat -> c10 j = 0 /\ c01 j = 0) /\
  ((3 <= n)%nat -> c20 j = 0 /\ c11 j = 0 /\ c02 j = 0) /\
  ((4 <= n)%nat -> c30 j = 0 /\ c21 j = 0 /\ c12 j = 0 /\ c03 j = 0).
Proof.
  intros n j H. assert (A0 : Rabs 0 <= 1) by (rewrite Rabs_R0; lra).
  assert (A1 : Rabs 1 <= 1) by (rewrite Rabs_R1; lra).
  assert (Am : Rabs (-1) <= 1) by (rewrite Rabs_left; lra).
  destruct (ray n j 1 0 A1 A0 H) as (Z & X1 & X2 & X3).
  destruct (ray n j 0 1 A0 A1 H) as (_ & Y1 & Y2 & Y3).
  destruct (ray n j 1 1 A1 A1 H) as (_ & _ & P2 & P3).
  destruct (ray n j 1 (-1) A1 Am H) as (_ & _ & _ & M3).
  unfold p1, p2, p3 in *.
  split. exact Z. split. { intros L. specialize (X1 L). specialize (Y1 L). lra. }
  split. { intros L. specialize (X2 L). specialize (Y2 L). specialize (P2 L). lra. }
  intros L. specialize (X3 L). specialize (Y3 L). specialize (P3 L). specialize (M3 L). lra.
Qed.

Lemma approx_unique_low : forall f i j, approx 3 f i -> approx 3 f j ->
  c00 i = c00 j /\ c10 i = c10 j /\ c01 i = c01 j /\ c20 i = c20 j /\ c11 i = c11 j /\ c02 i = c02 j.
Proof.
  intros f i j Hi Hj.
  assert (D : order 3 (ev (jminus real j i))).
  { apply order_ext with (2 := order_minus 3 _ _ Hi Hj). intros. destruct i, j. unfold_ev. ring. }
  destruct (small_jet 3 _ D) as (A & B & C & _).
  specialize (A ltac:(lia)). specialize (B ltac:(lia)). specialize (C ltac:(lia)).
  destruct i, j. simpl in *. lra.
Qed.

Theorem approx_unique : forall f i j, approx 4 f i -> approx 4 f j -> i = j.
Proof.
  intros f i j Hi Hj.
  assert (D : order 4 (ev (jminus real j i))).
  { apply order_ext with (2 := order_minus 4 _ _ Hi Hj). intros. destruct i, j. unfold_ev. ring. }
  destruct (small_jet 4 _ D) as (A & B & C & E).
  specialize (A ltac:(lia)). specialize (B ltac:(lia)). specialize (C ltac:(lia)).
  specialize (E ltac:(lia)). destruct i, j. simpl in *. f_equal; lra.
Qed.

(** ** Integration *)

(** The polynomial of value [k] with the derivatives p, q, by the way over (a, 0). *)

Definition over (k : R) (p q : jet R) : jet R :=
  Jet k (c00 p) (c00 q) (c10 p / 2) (c10 q) (c01 q / 2) (c20 p / 3) (c20 q) (c11 q / 2) (c02 q / 3).

Definition derivatives (F P Q : R -> R -> R) : Prop := exists d, 0 < d /\ forall a b, size a b < d ->
  is_derive (fun s => F s b) a (P a b) /\ is_derive (fun s => F a s) b (Q a b).

Lemma MVT_bound : forall (h h' : R -> R) y M, (forall t, Rmin 0 y <= t <= Rmax 0 y ->
  is_derive h t (h' t) /\ Rabs (h' t) <= M) -> Rabs (h y - h 0) <= M * Rabs y.
Proof.
  intros h h' y M H. destruct (MVT_gen h 0 y h') as [c [Hc E]].
  - intros t Ht. apply H. lra.
  - intros t Ht. apply continuity_pt_filterlim, (ex_derive_continuous h). eexists. apply H, Ht.
  - rewrite E, Rminus_0_r, Rabs_mult. apply Rmult_le_compat_r. apply Rabs_pos. apply H, Hc.
Qed.

Lemma between_0 : forall y t, Rmin 0 y <= t <= Rmax 0 y -> Rabs t <= Rabs y.
Proof.
  intros y t H. destruct (Rle_dec 0 y) as [L | L].
  - rewrite Rmin_left, Rmax_right in H by lra. rewrite !Rabs_pos_eq; lra.
  - rewrite Rmin_right, Rmax_left in H by lra. rewrite !Rabs_left1; lra.
Qed.

Lemma integrate : forall n F P Q p q, (n <= 3)%nat -> derivatives F P Q ->
  approx n P p -> approx n Q q -> approx (S n) F (over (F 0 0) p q).
Proof.
  intros n F P Q p q Hn (d0 & Hd0 & D) HP HQ.
  assert (W : forall j, order n (p3 j)) by (intros j; apply order_weaken with (2 := order_p3 j); exact Hn).
  destruct (order_plus n _ _ HP (W p)) as (K & d1 & HK & Hd1 & _ & H1).
  destruct (order_plus n _ _ HQ (W q)) as (L & d2 & HL & Hd2 & _ & H2). simpl in H1, H2.
  set (d := Rmin 1 (Rmin d0 (Rmin d1 d2))).
  assert (Hd : 0 < d) by (repeat apply Rmin_glb_lt; lra).
  assert (L0 : d <= 1) by apply Rmin_l.
  assert (L1 : d <= d0). { eapply Rle_trans. apply Rmin_r. apply Rmin_l. }
  assert (L2 : d <= d1). { eapply Rle_trans. apply Rmin_r. eapply Rle_trans. apply Rmin_r. apply Rmin_l. }
  assert (L3 : d <= d2). { eapply Rle_trans. apply Rmin_r. eapply Rle_trans. apply Rmin_r. apply Rmin_r. }
  exists (K + L), d. split. lra. split. exact Hd. split. exact L0. intros a b Hs.
  set (j := over (F 0 0) p q). set (E := fun a b => F a b - ev j a b).
  assert (S := size_pos a b). assert (Sn := pow_le _ n S).
  assert (Sa : Rabs a <= size a b) by apply Rmax_l. assert (Sb : Rabs b <= size a b) by apply Rmax_r.
  assert (Mono : forall s t, Rabs s <= Rabs a -> Rabs t <= Rabs b -> size s t <= size a b).
  { intros s t Hs' Ht. unfold size. apply Rmax_lub. apply Rle_trans with (Rabs a). exact Hs'.
    apply Rmax_l. apply Rle_trans with (Rabs b). exact Ht. apply Rmax_r. }
  assert (A1 : Rabs (E a 0 - E 0 0) <= K * size a b ^ n * Rabs a).
  { apply (MVT_bound (fun s => E s 0) (fun s => P s 0 - ev p s 0 + p3 p s 0)). intros t Ht.
    assert (Ht' := between_0 a t Ht).
    assert (St : size t 0 <= size a b) by (apply Mono; [exact Ht' | rewrite Rabs_R0; apply Rabs_pos]).
    split.
    - evar_last. apply (is_derive_minus (fun s => F s 0) (fun s => ev j s 0)).
      exact (proj1 (D t 0 ltac:(lra))). unfold ev. auto_derive. exact I. reflexivity.
      unfold minus, plus, opp, j, over. simpl. unfold p3, ev. field.
    - eapply Rle_trans. apply H1. lra. apply Rmult_le_compat_l. exact HK.
      apply pow_incr. split. apply size_pos. exact St. }
  assert (A2 : Rabs (E a b - E a 0) <= L * size a b ^ n * Rabs b).
  { apply (MVT_bound (fun s => E a s) (fun s => Q a s - ev q a s + p3 q a s)). intros t Ht.
    assert (Ht' := between_0 b t Ht).
    assert (St : size a t <= size a b) by (apply Mono; [lra | exact Ht']).
    split.
    - evar_last. apply (is_derive_minus (fun s => F a s) (fun s => ev j a s)).
      exact (proj2 (D a t ltac:(lra))). unfold ev. auto_derive. exact I. reflexivity.
      unfold minus, plus, opp, j, over. simpl. unfold p3, ev. field.
    - eapply Rle_trans. apply H2. lra. apply Rmult_le_compat_l. exact HL.
      apply pow_incr. split. apply size_pos. exact St. }
  assert (Z : E 0 0 = 0). { unfold E, j, over, ev. simpl. field. }
  rewrite Z, Rminus_0_r in A1. change (Rabs (E a b) <= (K + L) * size a b ^ Datatypes.S n). simpl.
  replace (E a b) with (E a 0 + (E a b - E a 0)) by ring. eapply Rle_trans. apply Rabs_triang.
  assert (B1 : K * size a b ^ n * Rabs a <= K * size a b ^ n * size a b).
  { apply Rmult_le_compat_l. apply Rmult_le_pos; assumption. exact Sa. }
  assert (B2 : L * size a b ^ n * Rabs b <= L * size a b ^ n * size a b).
  { apply Rmult_le_compat_l. apply Rmult_le_pos; assumption. exact Sb. }
  lra.
Qed.
