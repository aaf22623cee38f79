(** * Complex functions of (a, b) up to O(4), as polynomials in z = a + ib and its conjugate

    [capprox f j]: f(a, b) = j(z, conj z) + O(4).  Such polynomials add, multiply (truncated) and
    conjugate like the functions, and they are unique. *)

From Coq Require Import Reals Lra Lia ZArith.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Order Jet Taylor.
Open Scope R_scope.

Definition complex : ops C := Ops (fun n => RtoC (IZR n)) Cplus Cmult Copp Cdiv.

Definition zeta (a b : R) : C := (a, b).

Lemma C_eq : forall x y : C, fst x = fst y -> snd x = snd y -> x = y.
Proof. intros [x1 x2] [y1 y2]. simpl. intros -> ->. reflexivity. Qed.

(** ** Orders *)

Definition corder (n : nat) (f : R -> R -> C) : Prop :=
  order n (fun a b => fst (f a b)) /\ order n (fun a b => snd (f a b)).

Lemma corder_ext : forall n f g, (forall a b, f a b = g a b) -> corder n f -> corder n g.
Proof.
  intros n f g E [H1 H2]. split; [apply order_ext with (2 := H1) | apply order_ext with (2 := H2)];
    intros; rewrite E; reflexivity.
Qed.

Lemma corder_weaken : forall n k f, (k <= n)%nat -> corder n f -> corder k f.
Proof. intros n k f L [H1 H2]. split; eapply order_weaken; eauto. Qed.

Lemma corder_plus : forall n f g, corder n f -> corder n g -> corder n (fun a b => f a b + g a b)%C.
Proof. intros n f g [F1 F2] [G1 G2]. split; simpl; apply order_plus; assumption. Qed.

Lemma corder_mult : forall n k f g, corder n f -> corder k g ->
  corder (n + k) (fun a b => f a b * g a b)%C.
Proof.
  intros n k f g [F1 F2] [G1 G2]. split; simpl.
  - apply order_minus; apply order_mult; assumption.
  - apply order_plus; apply order_mult; assumption.
Qed.

Lemma corder_const : forall c, corder 0 (fun _ _ => c).
Proof. intros c. split; simpl; apply order_const. Qed.

Lemma corder_scal : forall n c f, corder n f -> corder n (fun a b => c * f a b)%C.
Proof. intros n c f H. exact (corder_mult 0 n _ f (corder_const c) H). Qed.

Lemma corder_minus : forall n f g, corder n f -> corder n g -> corder n (fun a b => f a b - g a b)%C.
Proof.
  intros n f g [F1 F2] [G1 G2]. split; simpl; apply order_minus; assumption.
Qed.

Lemma corder_Z : corder 1 zeta /\ corder 1 (fun a b => Cconj (zeta a b)).
Proof.
  split; split; simpl. apply order_a. apply order_b. apply order_a.
  apply order_ext with (fun _ b => (-1) * b). intros; ring. apply order_scal, order_b.
Qed.

Lemma corder_conj : forall n f, corder n f -> corder n (fun a b => Cconj (f a b)).
Proof.
  intros n f [F1 F2]. split; simpl. exact F1.
  apply order_ext with (fun a b => (-1) * snd (f a b)). intros; ring. apply order_scal, F2.
Qed.

(** ** Polynomials in z and w, later the conjugate of z *)

Open Scope C_scope.

Definition cp1 (j : jet C) (z w : C) : C := c10 j * z + c01 j * w.
Definition cp2 (j : jet C) (z w : C) : C := c20 j * (z * z) + c11 j * (z * w) + c02 j * (w * w).
Definition cp3 (j : jet C) (z w : C) : C :=
  c30 j * (z * z * z) + c21 j * (z * z * w) + c12 j * (z * w * w) + c03 j * (w * w * w).
Definition cev (j : jet C) (z w : C) : C := c00 j + cp1 j z w + cp2 j z w + cp3 j z w.

Definition cevZ (j : jet C) (a b : R) : C := cev j (zeta a b) (Cconj (zeta a b)).

Definition capprox (f : R -> R -> C) (j : jet C) : Prop :=
  corder 4 (fun a b => f a b - cevZ j a b).

Ltac unfold_cev := unfold cevZ, cev, cp1, cp2, cp3 in *; simpl in *.

Lemma capprox_ext : forall f g j, (forall a b, f a b = g a b) -> capprox f j -> capprox g j.
Proof. intros f g j E. apply corder_ext. intros. rewrite E. reflexivity. Qed.

Lemma capprox_exact : forall f j, (forall a b, f a b = cevZ j a b) -> capprox f j.
Proof.
  intros f j E. apply corder_ext with (fun _ _ => RtoC 0).
  { intros. rewrite E. ring. }
  split; simpl; apply order_zero.
Qed.

Lemma capprox_close : forall f g j, capprox f j -> corder 4 (fun a b => f a b - g a b) -> capprox g j.
Proof.
  intros f g j Hf Hg. apply corder_ext with (2 := corder_minus 4 _ _ Hf Hg). intros; ring.
Qed.

Lemma corder_p : forall j,
  corder 1 (fun a b => cp1 j (zeta a b) (Cconj (zeta a b))) /\
  corder 2 (fun a b => cp2 j (zeta a b) (Cconj (zeta a b))) /\
  corder 3 (fun a b => cp3 j (zeta a b) (Cconj (zeta a b))).
Proof.
  intros j. destruct corder_Z as [Hz Hw].
  assert (ZZ := corder_mult 1 1 _ _ Hz Hz). assert (ZW := corder_mult 1 1 _ _ Hz Hw).
  assert (WW := corder_mult 1 1 _ _ Hw Hw).
  unfold cp1, cp2, cp3. split; [ | split]; repeat apply corder_plus; apply corder_scal; try assumption.
  exact (corder_mult 2 1 _ _ ZZ Hz). exact (corder_mult 2 1 _ _ ZZ Hw).
  exact (corder_mult 2 1 _ _ ZW Hw). exact (corder_mult 2 1 _ _ WW Hw).
Qed.

Lemma corder_cev : forall j, corder 0 (cevZ j).
Proof.
  intros j. destruct (corder_p j) as (P1 & P2 & P3). unfold cevZ, cev.
  apply corder_plus; [apply corder_plus; [apply corder_plus | ] | ]. apply corder_const.
  apply corder_weaken with (2 := P1). lia. apply corder_weaken with (2 := P2). lia.
  apply corder_weaken with (2 := P3). lia.
Qed.

Lemma corder_bounded : forall f j, capprox f j -> corder 0 f.
Proof.
  intros f j H. apply corder_ext with (fun a b => (f a b - cevZ j a b) + cevZ j a b).
  intros; ring. apply corder_plus. apply corder_weaken with (2 := H). lia. apply corder_cev.
Qed.

Lemma capprox_plus : forall f g i j, capprox f i -> capprox g j ->
  capprox (fun a b => f a b + g a b) (jplus complex i j).
Proof.
  intros f g i j Hf Hg. apply corder_ext with (2 := corder_plus 4 _ _ Hf Hg).
  intros. destruct i, j. unfold_cev. ring.
Qed.

Lemma capprox_scal : forall k f j, capprox f j -> capprox (fun a b => k * f a b) (jscal complex k j).
Proof.
  intros k f j Hf. apply corder_ext with (2 := corder_scal 4 k _ Hf).
  intros. destruct j. unfold_cev. ring.
Qed.

Lemma capprox_mult : forall f g i j, capprox f i -> capprox g j ->
  capprox (fun a b => f a b * g a b) (jmult complex i j).
Proof.
  intros f g i j Hf Hg.
  set (z := zeta). set (w := fun a b => Cconj (zeta a b)).
  apply corder_ext with (fun a b => (f a b - cevZ i a b) * g a b + cevZ i a b * (g a b - cevZ j a b) +
    (cp1 i (z a b) (w a b) * cp3 j (z a b) (w a b) + cp2 i (z a b) (w a b) * cp2 j (z a b) (w a b) +
     cp3 i (z a b) (w a b) * cp1 j (z a b) (w a b) + cp2 i (z a b) (w a b) * cp3 j (z a b) (w a b) +
     cp3 i (z a b) (w a b) * cp2 j (z a b) (w a b) + cp3 i (z a b) (w a b) * cp3 j (z a b) (w a b))).
  { intros a b. unfold cevZ, z, w. generalize (zeta a b) (Cconj (zeta a b)). intros u v.
    destruct i, j. unfold_cev. ring. }
  destruct (corder_p i) as (I1 & I2 & I3). destruct (corder_p j) as (J1 & J2 & J3).
  assert (W : forall k h, (4 <= k)%nat -> corder k h -> corder 4 h).
  { intros k h L. apply corder_weaken, L. }
  repeat apply corder_plus.
  - exact (corder_mult 4 0 _ _ Hf (corder_bounded g j Hg)).
  - exact (corder_mult 0 4 _ _ (corder_cev i) Hg).
  - exact (corder_mult 1 3 _ _ I1 J3).
  - exact (corder_mult 2 2 _ _ I2 J2).
  - exact (corder_mult 3 1 _ _ I3 J1).
  - apply (W 5%nat). lia. exact (corder_mult 2 3 _ _ I2 J3).
  - apply (W 5%nat). lia. exact (corder_mult 3 2 _ _ I3 J2).
  - apply (W 6%nat). lia. exact (corder_mult 3 3 _ _ I3 J3).
Qed.

(** The conjugate. *)

Lemma conj_plus : forall x y, Cconj (x + y) = Cconj x + Cconj y.
Proof. intros. apply C_eq; simpl; ring. Qed.

Lemma conj_mult : forall x y, Cconj (x * y) = Cconj x * Cconj y.
Proof. intros. apply C_eq; simpl; ring. Qed.

Lemma conj_conj : forall x, Cconj (Cconj x) = x.
Proof. intros. apply C_eq; simpl; ring. Qed.

Definition jbar (j : jet C) : jet C :=
  Jet (Cconj (c00 j)) (Cconj (c01 j)) (Cconj (c10 j)) (Cconj (c02 j)) (Cconj (c11 j)) (Cconj (c20 j))
      (Cconj (c03 j)) (Cconj (c12 j)) (Cconj (c21 j)) (Cconj (c30 j)).

Lemma cevZ_bar : forall j a b, cevZ (jbar j) a b = Cconj (cevZ j a b).
Proof.
  intros j a b. unfold cevZ, cev, cp1, cp2, cp3, jbar.
  repeat rewrite ?conj_plus, ?conj_mult, ?conj_conj. simpl c00. simpl c10. simpl c01. simpl c20.
  simpl c11. simpl c02. simpl c30. simpl c21. simpl c12. simpl c03. ring.
Qed.

Lemma capprox_conj : forall f j, capprox f j -> capprox (fun a b => Cconj (f a b)) (jbar j).
Proof.
  intros f j H. apply corder_ext with (2 := corder_conj _ _ H). intros a b. rewrite cevZ_bar.
  apply C_eq; simpl; ring.
Qed.

(** ** Uniqueness *)

Definition jre (j : jet C) : jet R :=
  Jet (fst (c00 j)) (fst (c10 j) + fst (c01 j))%R (- snd (c10 j) + snd (c01 j))%R
      (fst (c20 j) + fst (c11 j) + fst (c02 j))%R (2 * (- snd (c20 j) + snd (c02 j)))%R
      (- fst (c20 j) + fst (c11 j) - fst (c02 j))%R
      (fst (c30 j) + fst (c21 j) + fst (c12 j) + fst (c03 j))%R
      (- 3 * snd (c30 j) - snd (c21 j) + snd (c12 j) + 3 * snd (c03 j))%R
      (- 3 * fst (c30 j) + fst (c21 j) + fst (c12 j) - 3 * fst (c03 j))%R
      (snd (c30 j) - snd (c21 j) + snd (c12 j) - snd (c03 j))%R.

Definition jtimes_i (j : jet C) : jet C := jscal complex (0, (-1)%R) j.

Lemma jre_is : forall j a b, ev (jre j) a b = fst (cevZ j a b).
Proof. intros j a b. destruct j. unfold jre, cevZ, cev, cp1, cp2, cp3, ev. simpl. ring. Qed.

Lemma jim_is : forall j a b, ev (jre (jtimes_i j)) a b = snd (cevZ j a b).
Proof.
  intros j a b. rewrite jre_is. destruct j. unfold cevZ, cev, cp1, cp2, cp3, jtimes_i. simpl. ring.
Qed.

Theorem capprox_unique : forall f i j, capprox f i -> capprox f j -> i = j.
Proof.
  intros f i j Hi Hj.
  set (k := jplus complex j (jscal complex (- (1))%C i)).
  assert (D : corder 4 (cevZ k)).
  { apply corder_ext with (2 := corder_minus 4 _ _ Hi Hj). intros a b. unfold k.
    destruct i, j. unfold_cev. ring. }
  destruct D as [Dr Di].
  assert (Er : order 4 (ev (jre k))) by (apply order_ext with (2 := Dr); intros; symmetry; apply jre_is).
  assert (Ei : order 4 (ev (jre (jtimes_i k))))
    by (apply order_ext with (2 := Di); intros; symmetry; apply jim_is).
  destruct (small_jet 4 _ Er) as (A0 & A1 & A2 & A3). destruct (small_jet 4 _ Ei) as (B0 & B1 & B2 & B3).
  specialize (A0 ltac:(lia)). specialize (A1 ltac:(lia)). specialize (A2 ltac:(lia)).
  specialize (A3 ltac:(lia)). specialize (B0 ltac:(lia)). specialize (B1 ltac:(lia)).
  specialize (B2 ltac:(lia)). specialize (B3 ltac:(lia)).
  unfold k, jtimes_i, jre in *. destruct i, j. simpl in *.
  f_equal; apply C_eq; lra.
Qed.
