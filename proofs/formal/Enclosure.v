(** * Intervals: coq-interval on Coq's own integers

    Its tactic computes on machine integers, which are axioms of Coq ([Uint63]); with mantissas of
    type Z nothing but the axioms of the real numbers remains.  [inn x X]: the real number x is in the
    interval X.  Division by an interval around 0 gives the interval of everything. *)

From Coq Require Import Reals Lra ZArith Bool.
From Interval.Real Require Import Xreal.
From Interval.Float Require Import Specific_stdz Specific_ops.
From Interval.Interval Require Import Interval Float_full.
From Cap Require Import Statement Jet.
Open Scope R_scope.

Module F := SpecificFloat StdZRadix2.
Module I := FloatIntervalFull F.

Definition inn (x : R) (X : I.type) : Prop := contains (I.convert X) (Xreal x).

(** ** Operations *)

Section Operations.

Variable p : F.precision.

Definition iv : ops I.type := Ops (I.fromZ p) (I.add p) (I.mul p) I.neg (I.div p).

Lemma inn_Z : forall n, inn (IZR n) (I.fromZ p n).
Proof. intros. apply I.fromZ_correct. Qed.

Lemma inn_add : forall x y X Y, inn x X -> inn y Y -> inn (x + y) (I.add p X Y).
Proof. intros x y X Y. apply (I.add_correct p X Y (Xreal x) (Xreal y)). Qed.

Lemma inn_sub : forall x y X Y, inn x X -> inn y Y -> inn (x - y) (I.sub p X Y).
Proof. intros x y X Y. apply (I.sub_correct p X Y (Xreal x) (Xreal y)). Qed.

Lemma inn_mul : forall x y X Y, inn x X -> inn y Y -> inn (x * y) (I.mul p X Y).
Proof. intros x y X Y. apply (I.mul_correct p X Y (Xreal x) (Xreal y)). Qed.

Lemma inn_neg : forall x X, inn x X -> inn (- x) (I.neg X).
Proof. intros x X. apply (I.neg_correct X (Xreal x)). Qed.

Lemma inn_everything : forall X x, contains (I.convert X) Xnan -> inn x X.
Proof.
  intros X x. unfold inn. destruct (I.convert X). intros _. exact I. intros [].
Qed.

Lemma inn_div : forall x y X Y, inn x X -> inn y Y -> inn (x / y) (I.div p X Y).
Proof.
  intros x y X Y Hx Hy. assert (H := I.div_correct p X Y (Xreal x) (Xreal y) Hx Hy).
  simpl in H. unfold Xdiv' in H. destruct (is_zero y). apply inn_everything, H. exact H.
Qed.

Lemma inn_inv : forall x X, inn x X -> inn (/ x) (I.inv p X).
Proof.
  intros x X Hx. assert (H := I.inv_correct p X (Xreal x) Hx).
  simpl in H. unfold Xinv' in H. destruct (is_zero x). apply inn_everything, H. exact H.
Qed.

Lemma inn_sqrt : forall x X, inn x X -> inn (sqrt x) (I.sqrt p X).
Proof. intros x X. apply (I.sqrt_correct p X (Xreal x)). Qed.

Lemma inn_sin : forall x X, inn x X -> inn (sin x) (I.sin p X).
Proof. intros x X. apply (I.sin_correct p X (Xreal x)). Qed.

Lemma inn_cos : forall x X, inn x X -> inn (cos x) (I.cos p X).
Proof. intros x X. apply (I.cos_correct p X (Xreal x)). Qed.

Lemma inn_atan : forall x X, inn x X -> inn (atan x) (I.atan p X).
Proof. intros x X. apply (I.atan_correct p X (Xreal x)). Qed.

Lemma inn_abs : forall x X, inn x X -> inn (Rabs x) (I.abs X).
Proof. intros x X. apply (I.abs_correct X (Xreal x)). Qed.

Lemma inn_PI : inn PI (I.pi p).
Proof. apply I.pi_correct. Qed.

End Operations.

(** ** Comparisons *)

Definition is_pos (X : I.type) : bool := match I.sign_strict X with Xgt => true | _ => false end.
Definition is_neg (X : I.type) : bool := match I.sign_strict X with Xlt => true | _ => false end.
Definition is_nonneg (X : I.type) : bool :=
  match I.sign_large X with Xgt | Xeq => true | _ => false end.

Lemma is_pos_ok : forall x X, inn x X -> is_pos X = true -> 0 < x.
Proof.
  intros x X Hx. unfold is_pos. assert (H := I.sign_strict_correct X).
  destruct (I.sign_strict X); try discriminate. intros _. apply (H _ Hx).
Qed.

Lemma is_neg_ok : forall x X, inn x X -> is_neg X = true -> x < 0.
Proof.
  intros x X Hx. unfold is_neg. assert (H := I.sign_strict_correct X).
  destruct (I.sign_strict X); try discriminate. intros _. apply (H _ Hx).
Qed.

Lemma is_nonneg_ok : forall x X, inn x X -> is_nonneg X = true -> 0 <= x.
Proof.
  intros x X Hx. unfold is_nonneg. assert (H := I.sign_large_correct X).
  destruct (I.sign_large X); try discriminate; intros _; specialize (H _ Hx).
  - inversion H. lra.
  - apply H.
Qed.

(** ** The interval between two intervals *)

Lemma inn_hull : forall x y z X Y, inn x X -> inn z Y -> Rmin x z <= y <= Rmax x z ->
  inn y (I.join X Y).
Proof.
  intros x y z X Y Hx Hz H.
  assert (Jx := I.join_correct X Y (Xreal x) (or_introl Hx)).
  assert (Jz := I.join_correct X Y (Xreal z) (or_intror Hz)).
  unfold inn. destruct (Rle_dec x z) as [L | L].
  - rewrite Rmin_left, Rmax_right in H by lra. exact (contains_connected _ _ _ Jx Jz y H).
  - rewrite Rmin_right, Rmax_left in H by lra. exact (contains_connected _ _ _ Jz Jx y H).
Qed.

Lemma inn_between : forall x y z X Y, inn x X -> inn z Y -> x <= y <= z -> inn y (I.join X Y).
Proof.
  intros x y z X Y Hx Hz H. apply (inn_hull x y z); try assumption.
  rewrite Rmin_left, Rmax_right; lra.
Qed.

(** ** Polynomials *)

Definition jinn (j : jet R) (J : jet I.type) : Prop :=
  inn (c00 j) (c00 J) /\ inn (c10 j) (c10 J) /\ inn (c01 j) (c01 J) /\
  inn (c20 j) (c20 J) /\ inn (c11 j) (c11 J) /\ inn (c02 j) (c02 J) /\
  inn (c30 j) (c30 J) /\ inn (c21 j) (c21 J) /\ inn (c12 j) (c12 J) /\ inn (c03 j) (c03 J).

(** [inn_auto] proves inclusions that follow the structure of the real expression. *)

Create HintDb inn discriminated.
#[export] Hint Resolve inn_Z inn_add inn_sub inn_mul inn_neg inn_div inn_inv inn_sqrt inn_sin inn_cos
  inn_atan inn_PI : inn.

Ltac inn_auto := auto 50 with inn.

(** A test that succeeded says that y > 0, or y >= 0. *)

Ltac is_positive H y := apply is_pos_ok with (x := y) in H; [ | inn_auto ].
Ltac is_nonnegative H y := apply is_nonneg_ok with (x := y) in H; [ | inn_auto ].

Section Jets.

Variable p : F.precision.
Notation ivp := (iv p).

Ltac jets := repeat match goal with
  | j : jet R |- _ => destruct j
  | j : jet I.type |- _ => destruct j end;
  cbv beta iota zeta delta [jinn jconst ja jb jplus jscal jmult jset jsquare jcube real iv
    add mul neg div of_Z c00 c10 c01 c20 c11 c02 c30 c21 c12 c03] in *;
  repeat match goal with H : _ /\ _ |- _ => destruct H end;
  repeat (lazymatch goal with |- _ /\ _ => split | _ => fail end); inn_auto.

Lemma jinn_const : forall x X, inn x X -> jinn (jconst real x) (jconst ivp X).
Proof. intros x X H. jets. Qed.

Lemma jinn_a : forall x X, inn x X -> jinn (ja real x) (ja ivp X).
Proof. intros x X H. jets. Qed.

Lemma jinn_b : forall x X, inn x X -> jinn (jb real x) (jb ivp X).
Proof. intros x X H. jets. Qed.

Lemma jinn_plus : forall i j A B, jinn i A -> jinn j B -> jinn (jplus real i j) (jplus ivp A B).
Proof. intros i j A B Hi Hj. jets. Qed.

Lemma jinn_scal : forall k j K J, inn k K -> jinn j J -> jinn (jscal real k j) (jscal ivp K J).
Proof. intros k j K J Hk Hj. jets. Qed.

Lemma jinn_mult : forall i j A B, jinn i A -> jinn j B -> jinn (jmult real i j) (jmult ivp A B).
Proof. intros i j A B Hi Hj. jets. Qed.

Lemma jinn_set : forall x X j J, inn x X -> jinn j J -> jinn (jset x j) (jset X J).
Proof. intros x X j J Hx Hj. jets. Qed.

Lemma jinn_square : forall j J, jinn j J -> jinn (jsquare real j) (jsquare ivp J).
Proof. intros j J Hj. jets. Qed.

Lemma jinn_cube : forall j J, jinn j J -> jinn (jcube real j) (jcube ivp J).
Proof. intros j J Hj. jets. Qed.

Lemma jinn_minus : forall i j A B, jinn i A -> jinn j B -> jinn (jminus real i j) (jminus ivp A B).
Proof.
  intros i j A B Hi Hj. apply jinn_plus. exact Hi. apply jinn_scal. apply inn_Z. exact Hj.
Qed.

Lemma jinn_even : forall j J, jinn j J -> jinn (jeven real j) (jeven ivp J).
Proof.
  intros j J Hj. apply jinn_plus. apply jinn_const, (inn_Z p 1).
  apply jinn_scal. apply inn_div; apply inn_Z. apply jinn_square, Hj.
Qed.

Lemma jinn_odd : forall j J, jinn j J -> jinn (jodd real j) (jodd ivp J).
Proof.
  intros j J Hj. apply jinn_plus. apply jinn_set. apply (inn_Z p 0). exact Hj.
  apply jinn_scal. apply inn_div; apply inn_Z. apply jinn_cube, Hj.
Qed.

Lemma jinn_sin : forall s c j S C J, inn s S -> inn c C -> jinn j J ->
  jinn (jsin real s c j) (jsin ivp S C J).
Proof.
  intros s c j S C J Hs Hc Hj. apply jinn_plus; apply jinn_scal; auto.
  apply jinn_even, Hj. apply jinn_odd, Hj.
Qed.

Lemma jinn_cos : forall s c j S C J, inn s S -> inn c C -> jinn j J ->
  jinn (jcos real s c j) (jcos ivp S C J).
Proof.
  intros s c j S C J Hs Hc Hj. apply jinn_plus; apply jinn_scal; auto.
  apply jinn_even, Hj. apply inn_neg, Hs. apply jinn_odd, Hj.
Qed.

End Jets.

#[export] Hint Resolve jinn_const jinn_a jinn_b jinn_plus jinn_scal jinn_mult jinn_set jinn_minus
  jinn_sin jinn_cos : inn.
