(** * Polynomials of degree three, for functions that are known up to O(4)

    [approx n f j]: f = j + O(n), n <= 4; for sums and for truncated products.  The operations on
    coefficients are those of any ring [ops]: real numbers here, intervals in the checker. *)

From Coq Require Import Reals Lra Lia ZArith.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Order.
Open Scope R_scope.

(** ** Operations *)

Record ops (K : Type) := Ops { of_Z : Z -> K; add : K -> K -> K; mul : K -> K -> K;
                               neg : K -> K; div : K -> K -> K }.
Arguments Ops {K}. Arguments of_Z {K}. Arguments add {K}. Arguments mul {K}. Arguments neg {K}.
Arguments div {K}.

Definition real : ops R := Ops IZR Rplus Rmult Ropp Rdiv.

Section Operations.

Variables (K : Type) (o : ops K).
Declare Scope K_scope.
Open Scope K_scope.
Notation "x + y" := (add o x y) : K_scope.
Notation "x * y" := (mul o x y) : K_scope.
Notation "- x" := (neg o x) : K_scope.
Notation "# n" := (of_Z o n) (at level 5) : K_scope.

Definition jconst (c : K) : jet K :=
  let z := #0 in Jet c z z z z z z z z z.
Definition ja (c : K) : jet K :=
  let z := #0 in Jet c #1 z z z z z z z z.
Definition jb (c : K) : jet K :=
  let z := #0 in Jet c z #1 z z z z z z z.

Definition jplus (i j : jet K) : jet K :=
  match i, j with
  | Jet a00 a10 a01 a20 a11 a02 a30 a21 a12 a03, Jet b00 b10 b01 b20 b11 b02 b30 b21 b12 b03 =>
    Jet (a00 + b00) (a10 + b10) (a01 + b01) (a20 + b20) (a11 + b11) (a02 + b02)
      (a30 + b30) (a21 + b21) (a12 + b12) (a03 + b03)
  end.

Definition jscal (k : K) (j : jet K) : jet K :=
  match j with
  | Jet b00 b10 b01 b20 b11 b02 b30 b21 b12 b03 =>
    Jet (k * b00) (k * b10) (k * b01) (k * b20) (k * b11) (k * b02)
      (k * b30) (k * b21) (k * b12) (k * b03)
  end.

Definition jmult (i j : jet K) : jet K :=
  match i, j with
  | Jet a00 a10 a01 a20 a11 a02 a30 a21 a12 a03, Jet b00 b10 b01 b20 b11 b02 b30 b21 b12 b03 =>
    Jet (a00 * b00)
      (a00 * b10 + a10 * b00)
      (a00 * b01 + a01 * b00)
      (a00 * b20 + a10 * b10 + a20 * b00)
      (a00 * b11 + a10 * b01 + a01 * b10 + a11 * b00)
      (a00 * b02 + a01 * b01 + a02 * b00)
      (a00 * b30 + a10 * b20 + a20 * b10 + a30 * b00)
      (a00 * b21 + a10 * b11 + a01 * b20 + a11 * b10 + a20 * b01 + a21 * b00)
      (a00 * b12 + a01 * b11 + a10 * b02 + a11 * b01 + a02 * b10 + a12 * b00)
      (a00 * b03 + a01 * b02 + a02 * b01 + a03 * b00)
  end.

Definition jminus (i j : jet K) : jet K := jplus i (jscal #(-1) j).

(** With another constant term. *)

Definition jset (c : K) (j : jet K) : jet K :=
  match j with
  | Jet _ b10 b01 b20 b11 b02 b30 b21 b12 b03 => Jet c b10 b01 b20 b11 b02 b30 b21 b12 b03
  end.

(** Without the constant term; the square and the cube of that. *)

Definition jsmall (j : jet K) : jet K := jset #0 j.

Definition jsquare (j : jet K) : jet K :=
  match j with
  | Jet _ b10 b01 b20 b11 b02 _ _ _ _ =>
    let z := #0 in let t := #2 in
    Jet z z z (b10 * b10) (t * (b10 * b01)) (b01 * b01)
      (t * (b10 * b20)) (t * (b10 * b11 + b01 * b20)) (t * (b10 * b02 + b01 * b11))
      (t * (b01 * b02))
  end.

Definition jcube (j : jet K) : jet K :=
  match j with
  | Jet _ b10 b01 _ _ _ _ _ _ _ =>
    let z := #0 in let t := #3 in
    Jet z z z z z z
      (b10 * b10 * b10) (t * (b10 * b10 * b01)) (t * (b10 * b01 * b01)) (b01 * b01 * b01)
  end.

(** Sine and cosine, from those of the constant term. *)

Definition jeven (j : jet K) : jet K :=
  jplus (jconst #1) (jscal (div o #(-1) #2) (jsquare j)).
Definition jodd (j : jet K) : jet K :=
  jplus (jsmall j) (jscal (div o #(-1) #6) (jcube j)).
Definition jsin (s c : K) (j : jet K) : jet K := jplus (jscal s (jeven j)) (jscal c (jodd j)).
Definition jcos (s c : K) (j : jet K) : jet K := jplus (jscal c (jeven j)) (jscal (- s) (jodd j)).

End Operations.

Arguments jconst {K}. Arguments ja {K}. Arguments jb {K}. Arguments jplus {K}.
Arguments jscal {K}. Arguments jmult {K}. Arguments jminus {K}. Arguments jset {K}. Arguments jsmall {K}.
Arguments jsquare {K}. Arguments jcube {K}. Arguments jeven {K}. Arguments jodd {K}.
Arguments jsin {K}. Arguments jcos {K}.

(** ** Real functions up to O(n), n <= 4 *)

Definition approx (n : nat) (f : R -> R -> R) (j : jet R) : Prop :=
  order n (fun a b => f a b - ev j a b).

Definition p1 j a b := c10 j * a + c01 j * b.
Definition p2 j a b := c20 j * (a * a) + c11 j * (a * b) + c02 j * (b * b).
Definition p3 j a b :=
  c30 j * (a * a * a) + c21 j * (a * a * b) + c12 j * (a * b * b) + c03 j * (b * b * b).

Lemma ev_is : forall j a b, ev j a b = c00 j + p1 j a b + p2 j a b + p3 j a b.
Proof. reflexivity. Qed.

Lemma order_p1 : forall j, order 1 (p1 j).
Proof.
  intros j. unfold p1. apply order_plus; apply order_scal. apply order_a. apply order_b.
Qed.

Lemma order_p2 : forall j, order 2 (p2 j).
Proof.
  intros j. unfold p2. repeat apply order_plus; apply order_scal.
  exact (order_mult 1 1 _ _ order_a order_a). exact (order_mult 1 1 _ _ order_a order_b).
  exact (order_mult 1 1 _ _ order_b order_b).
Qed.

Lemma order_p3 : forall j, order 3 (p3 j).
Proof.
  intros j. unfold p3. repeat apply order_plus; apply order_scal.
  exact (order_mult 2 1 _ _ (order_mult 1 1 _ _ order_a order_a) order_a).
  exact (order_mult 2 1 _ _ (order_mult 1 1 _ _ order_a order_a) order_b).
  exact (order_mult 2 1 _ _ (order_mult 1 1 _ _ order_a order_b) order_b).
  exact (order_mult 2 1 _ _ (order_mult 1 1 _ _ order_b order_b) order_b).
Qed.

Lemma order_ev : forall j, order 0 (ev j).
Proof.
  intros j. unfold ev. change (order 0 (fun a b => c00 j + p1 j a b + p2 j a b + p3 j a b)).
  apply order_plus; [apply order_plus; [apply order_plus | ] | ]. apply order_const.
  apply order_weaken with (2 := order_p1 j). lia. apply order_weaken with (2 := order_p2 j). lia.
  apply order_weaken with (2 := order_p3 j). lia.
Qed.

Lemma approx_bounded : forall n f j, approx n f j -> order 0 f.
Proof.
  intros n f j H. apply order_ext with (fun a b => (f a b - ev j a b) + ev j a b). intros; ring.
  apply order_plus. apply order_weaken with (2 := H). lia. apply order_ev.
Qed.

Ltac unfold_ev := unfold ev, p1, p2, p3 in *; simpl in *.

Lemma approx_ext : forall n f g j, (forall a b, f a b = g a b) -> approx n f j -> approx n g j.
Proof. intros n f g j E. apply order_ext. intros a b. rewrite E. reflexivity. Qed.

Lemma approx_same : forall n f i j, i = j -> approx n f i -> approx n f j.
Proof. intros n f i j ->. auto. Qed.

Lemma approx_close : forall n f g j, approx n f j -> order n (fun a b => f a b - g a b) ->
  approx n g j.
Proof.
  intros n f g j Hf Hg. apply order_ext with (2 := order_minus n _ _ Hf Hg). intros; ring.
Qed.

Lemma approx_exact : forall n f j, (forall a b, f a b = ev j a b) -> approx n f j.
Proof.
  intros n f j E. apply order_ext with (fun _ _ => 0). 2: apply order_zero.
  intros. rewrite E. ring.
Qed.

Lemma approx_const : forall n c, approx n (fun _ _ => c) (jconst real c).
Proof. intros n c. apply approx_exact. intros. unfold_ev. ring. Qed.

Lemma approx_a : forall n c, approx n (fun a _ => c + a) (ja real c).
Proof. intros n c. apply approx_exact. intros. unfold_ev. ring. Qed.

Lemma approx_b : forall n c, approx n (fun _ b => c + b) (jb real c).
Proof. intros n c. apply approx_exact. intros. unfold_ev. ring. Qed.

Lemma approx_plus : forall n f g i j, approx n f i -> approx n g j ->
  approx n (fun a b => f a b + g a b) (jplus real i j).
Proof.
  intros n f g i j Hf Hg. apply order_ext with (2 := order_plus n _ _ Hf Hg).
  intros. destruct i, j. unfold_ev. ring.
Qed.

Lemma approx_scal : forall n k f j, approx n f j -> approx n (fun a b => k * f a b) (jscal real k j).
Proof.
  intros n k f j Hf. apply order_ext with (2 := order_scal n k _ Hf).
  intros. destruct j. unfold_ev. ring.
Qed.

Lemma approx_mult : forall n f g i j, (n <= 4)%nat -> approx n f i -> approx n g j ->
  approx n (fun a b => f a b * g a b) (jmult real i j).
Proof.
  intros n f g i j Hn Hf Hg.
  apply order_ext with (fun a b => (f a b - ev i a b) * g a b + ev i a b * (g a b - ev j a b) +
    (p1 i a b * p3 j a b + p2 i a b * p2 j a b + p3 i a b * p1 j a b +
     p2 i a b * p3 j a b + p3 i a b * p2 j a b + p3 i a b * p3 j a b)).
  { intros. destruct i, j. unfold_ev. ring. }
  assert (W : forall k h, (n <= k)%nat -> order k h -> order n h).
  { intros k h L. apply order_weaken, L. }
  repeat apply order_plus.
  - replace n with (n + 0)%nat by lia. exact (order_mult n 0 _ _ Hf (approx_bounded n g j Hg)).
  - exact (order_mult 0 n _ _ (order_ev i) Hg).
  - apply (W 4%nat). lia. exact (order_mult 1 3 _ _ (order_p1 i) (order_p3 j)).
  - apply (W 4%nat). lia. exact (order_mult 2 2 _ _ (order_p2 i) (order_p2 j)).
  - apply (W 4%nat). lia. exact (order_mult 3 1 _ _ (order_p3 i) (order_p1 j)).
  - apply (W 5%nat). lia. exact (order_mult 2 3 _ _ (order_p2 i) (order_p3 j)).
  - apply (W 5%nat). lia. exact (order_mult 3 2 _ _ (order_p3 i) (order_p2 j)).
  - apply (W 6%nat). lia. exact (order_mult 3 3 _ _ (order_p3 i) (order_p3 j)).
Qed.

Lemma approx_minus : forall n f g i j, approx n f i -> approx n g j ->
  approx n (fun a b => f a b - g a b) (jminus real i j).
Proof.
  intros n f g i j Hf Hg. apply approx_ext with (fun a b => f a b + (-1) * g a b).
  intros; ring. apply approx_plus. exact Hf. apply approx_scal, Hg.
Qed.

(** The constant term is the value; the linear part is the derivative. *)

Lemma approx_value : forall n f j, (1 <= n)%nat -> approx n f j -> f 0 0 = c00 j.
Proof.
  intros n f j Hn (K & d & HK & Hd & _ & H).
  assert (Z : size 0 0 = 0). { unfold size. rewrite Rabs_R0, Rmax_left; lra. }
  assert (Q := H 0 0). rewrite Z in Q. specialize (Q Hd).
  replace (0 ^ n) with 0 in Q by (symmetry; apply pow_ne_zero; lia).
  assert (P := Rabs_pos (f 0 0 - ev j 0 0)).
  assert (E : Rabs (f 0 0 - ev j 0 0) = 0) by lra. apply Rabs_eq_0 in E.
  unfold_ev. lra.
Qed.

Lemma approx_set : forall n f j c, (1 <= n)%nat -> approx n f j -> f 0 0 = c ->
  approx n f (jset c j).
Proof.
  intros n f j c Hn H <-. apply approx_same with (2 := H).
  rewrite (approx_value n f j Hn H). destruct j. reflexivity.
Qed.
