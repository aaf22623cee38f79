(** * The formulas of the expansion, for any ring

    The hit time A solves g(A) = 0; three steps A - g(A)/u1 of Newton's method from the constant t1,
    in polynomials of degree three, give A + O(4).  So for the second hit B; the speeds U, W after
    the hits and the state at 2 pi are explicit functions of A and B. *)

From Coq Require Import ZArith.
From Cap Require Import Statement Jet.

(** What they need: parameters, T = 2 pi, the state, the hits, and sin, cos, 1/speed at them. *)

Record around (K : Type) := Around {
  e_f : K; e_l : K; e_r : K; e_T : K; e_x : K; e_v : K;
  e_t1 : K; e_sin1 : K; e_cos1 : K; e_inv1 : K;
  e_t2 : K; e_sin2 : K; e_cos2 : K; e_inv2 : K }.
Arguments Around {K}. Arguments e_f {K}. Arguments e_l {K}. Arguments e_r {K}. Arguments e_T {K}.
Arguments e_x {K}. Arguments e_v {K}. Arguments e_t1 {K}. Arguments e_sin1 {K}.
Arguments e_cos1 {K}. Arguments e_inv1 {K}. Arguments e_t2 {K}. Arguments e_sin2 {K}.
Arguments e_cos2 {K}. Arguments e_inv2 {K}.

Section Formulas.

Variables (K : Type) (o : ops K) (e : around K).

Declare Scope jet_scope.
Open Scope jet_scope.
Notation "i + j" := (jplus o i j) : jet_scope.
Notation "i * j" := (jmult o i j) : jet_scope.
Notation "i - j" := (jminus o i j) : jet_scope.
Notation "k '.*' j" := (jscal o k j) (at level 40, left associativity) : jet_scope.
Notation "# n" := (of_Z o n) (at level 5) : jet_scope.

Let half_f := mul o (div o #(-1) #2) (e_f e).   (* - f / 2 *)
Let sin1 := jsin o (e_sin1 e) (e_cos1 e).
Let cos1 := jcos o (e_sin1 e) (e_cos1 e).
Let sin2 := jsin o (e_sin2 e) (e_cos2 e).
Let cos2 := jcos o (e_sin2 e) (e_cos2 e).

Definition jg1 (A : jet K) : jet K :=
  ja o (e_x e) + (jb o (e_v e) * A + (jconst o (add o #1 (neg o (e_r e))) - cos1 A + half_f .* (A * A))).
Definition step1 (A : jet K) : jet K := jset (e_t1 e) (A - e_inv1 e .* jg1 A).
Definition jt1 : jet K := step1 (step1 (step1 (jconst o (e_t1 e)))).
Definition jspeed1 (A : jet K) : jet K := jb o (e_v e) + (sin1 A - e_f e .* A).

Definition jg2 (A U B : jet K) : jet K :=
  let d := B - A in
  jconst o (add o (e_l e) (neg o (e_r e))) + (U * d + (cos2 B - cos1 A + (sin1 A * d + half_f .* (d * d)))).
Definition step2 (A U B : jet K) : jet K := jset (e_t2 e) (B - e_inv2 e .* jg2 A U B).
Definition jt2 (A U : jet K) : jet K := step2 A U (step2 A U (step2 A U (jconst o (e_t2 e)))).
Definition jspeed2 (A U B : jet K) : jet K := U + (sin1 A + e_f e .* A - (sin2 B + e_f e .* B)).

Definition final_x (B W : jet K) : jet K :=
  let d := jconst o (e_T e) - B in
  jconst o (add o (e_l e) #(-1)) + (W * d + (cos2 B - sin2 B * d + half_f .* (d * d))).
Definition final_v (B W : jet K) : jet K :=
  let d := jconst o (e_T e) - B in W - sin2 B - e_f e .* d.

Definition jmap : jet K * jet K :=
  let A := jt1 in let U := jspeed1 A in let B := jt2 A U in let W := jspeed2 A U B in
  (final_x B W, final_v B W).

End Formulas.

Arguments jmap {K}.
