(** * Moeckel's formula for any ring

    The number of Birkhoff.v, from the polynomials of the map, lambda = cs + i sn and
    omega = wr + i wi, with complex numbers as pairs: to be evaluated in intervals. *)

From Coq Require Import Reals ZArith.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Jet Complex Frame Birkhoff.

Section Formula.

Variables (K : Type) (o : ops K).
Declare Scope pair_scope.
Open Scope pair_scope.
Notation "# n" := (of_Z o n) (at level 5) : pair_scope.
Notation "x + y" := (add o (fst x) (fst y), add o (snd x) (snd y)) : pair_scope.
Notation "x * y" := (let p := x in let q := y in
  (add o (mul o (fst p) (fst q)) (neg o (mul o (snd p) (snd q))),
   add o (mul o (fst p) (snd q)) (mul o (snd p) (fst q)))) : pair_scope.

Definition cplus (x y : K * K) : K * K := x + y.
Definition cmult (x y : K * K) : K * K := x * y.
Definition cbar (x : K * K) : K * K := (fst x, neg o (snd x)).
Definition cscal (n : Z) (x : K * K) : K * K := (mul o #n (fst x), mul o #n (snd x)).
Definition cnorm (x : K * K) : K := add o (mul o (fst x) (fst x)) (mul o (snd x) (snd x)).

Variables (jx jv : jet K) (cs sn wr wi : K).

Let alpha : K * K := (div o #1 #2, div o wr (mul o #2 wi)).
Let beta : K * K := (#0, div o #(-1) (mul o #2 wi)).
Let term (x v : K) : K * K :=
  cmult (cs, neg o sn) (add o x (mul o wr v), mul o wi v).

Definition form2 (p q : K * K) : K * K :=
  cplus (cmult (term (c20 jx) (c20 jv)) (cmult p p))
  (cplus (cmult (term (c11 jx) (c11 jv)) (cmult p q))
         (cmult (term (c02 jx) (c02 jv)) (cmult q q))).

Definition form21 : K * K :=
  let a := alpha in let b := beta in let a' := cbar a in let b' := cbar b in
  cplus (cmult (term (c30 jx) (c30 jv)) (cscal 3 (cmult (cmult a a) a')))
  (cplus (cmult (term (c21 jx) (c21 jv)) (cplus (cmult (cmult a a) b') (cscal 2 (cmult (cmult a a') b))))
  (cplus (cmult (term (c12 jx) (c12 jv)) (cplus (cmult a' (cmult b b)) (cscal 2 (cmult (cmult a b) b'))))
         (cmult (term (c03 jx) (c03 jv)) (cscal 3 (cmult (cmult b b) b'))))).

Definition moeckel : K :=
  let less := add o cs #(-1) in
  let g1 := div o sn less in
  let g3 := div o (mul o sn (add o (mul o #2 cs) #(-1))) (mul o less (add o (mul o #2 cs) #1)) in
  mul o wi (add o (snd form21)
    (add o (mul o #3 (mul o (cnorm (form2 alpha beta)) g1))
           (mul o (cnorm (form2 (cbar alpha) (cbar beta))) g3))).

End Formula.

Arguments moeckel {K}.

Open Scope R_scope.

Lemma moeckel_is : forall jx jv cs sn wr wi,
  moeckel real jx jv cs sn wr wi = wi * twist_number jx jv cs sn wr wi.
Proof.
  intros jx jv cs sn wr wi. unfold twist_number.
  set (a := alpha wr wi). set (b := beta wi).
  assert (Ea : (div real (of_Z real 1) (of_Z real 2), div real wr (mul real (of_Z real 2) wi)) = a).
  { reflexivity. }
  assert (Eb : (of_Z real 0, div real (of_Z real (-1)) (mul real (of_Z real 2) wi)) = b).
  { apply C_eq; simpl; unfold Rdiv; ring. }
  unfold moeckel. cbv zeta.
  assert (F : forall p q, form2 R real jx jv cs sn wr wi p q =
    (term cs sn wr wi (c20 jx) (c20 jv) * p * p + term cs sn wr wi (c11 jx) (c11 jv) * p * q
     + term cs sn wr wi (c02 jx) (c02 jv) * q * q)%C).
  { intros [p1 p2] [q1 q2]. unfold form2, cplus, cmult, term. apply C_eq; simpl; ring. }
  assert (F21 : form21 R real jx jv cs sn wr wi = k21 jx jv cs sn wr wi).
  { unfold form21. rewrite Ea, Eb. unfold k21. fold a b. destruct a as [a1 a2]. destruct b as [b1 b2].
    unfold cplus, cmult, cscal, cbar, term. apply C_eq; simpl; ring. }
  rewrite F21. rewrite !F. rewrite Ea, Eb.
  change (cbar R real a) with (bar a). change (cbar R real b) with (bar b).
  unfold k20, k02. fold a b. unfold cnorm, norm2, g1, g3.
  cbn [add mul neg div of_Z real]. f_equal.
  replace (cs + -1) with (cs - 1) by ring. replace (2 * cs + -1) with (2 * cs - 1) by ring. ring.
Qed.
