(** * A saddle from inequalities between numbers: |trace| > 2

    The eigenvalues are m = (t + s sqrt (t^2 - 4))/2 and 1/m, with t the trace and s its sign. *)

From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement.
Open Scope R_scope.

Definition eigenvalue (t s : R) : R := (t + s * sqrt (t * t - 4)) / 2.

Lemma eigenvalue_is : forall t s, s = 1 \/ s = -1 -> 2 < s * t ->
  t = eigenvalue t s + / eigenvalue t s /\ 1 < Rabs (eigenvalue t s) /\
  / eigenvalue t s = eigenvalue t (- s).
Proof.
  intros t s Hs H. assert (P : 0 < t * t - 4) by (destruct Hs as [-> | ->]; nra).
  assert (Q := sqrt_lt_R0 _ P). assert (E := sqrt_sqrt _ (Rlt_le _ _ P)).
  unfold eigenvalue. set (q := sqrt (t * t - 4)) in *.
  assert (Prod : (t + s * q) / 2 * ((t + - s * q) / 2) = 1) by (destruct Hs as [-> | ->]; lra).
  assert (N : (t + s * q) / 2 <> 0) by (intros Z; rewrite Z in Prod; lra).
  assert (Inv : / ((t + s * q) / 2) = (t + - s * q) / 2).
  { apply Rmult_eq_reg_l with ((t + s * q) / 2). 2: exact N. rewrite Rinv_r by exact N. auto. }
  split. { rewrite Inv. lra. } split. 2: exact Inv.
  destruct Hs as [-> | ->].
  - rewrite Rabs_pos_eq; lra.
  - rewrite Rabs_left; lra.
Qed.

Section Saddle.

Variables (x v : R) (jx jv : jet R) (s : R).
Let t := c10 jx + c01 jv.

Record saddle_numbers (c : saddle_claims) : Prop := {
  n_state : within (state_x c) x /\ within (state_v c) v;
  n_derivative : within (x_x c) (c10 jx) /\ within (x_v c) (c01 jx) /\
    within (v_x c) (c10 jv) /\ within (v_v c) (c01 jv);
  n_saddle : (s = 1 \/ s = -1) /\ 2 < s * t;
  n_outer : within (outer c) (eigenvalue t s);
  n_inner : within (inner c) (eigenvalue t (- s)) }.

Theorem saddle_of_numbers : forall c X V, saddle_numbers c -> saddle c X V x v jx jv.
Proof.
  intros c X V N. destruct (n_state c N) as [A B]. destruct (n_derivative c N) as (D1 & D2 & D3 & D4).
  destruct (n_saddle c N) as [Hs Ht]. destruct (eigenvalue_is t s Hs Ht) as (Sum & Out & Inv).
  split. exact A. split. exact B. split. exact D1. split. exact D2. split. exact D3. split. exact D4.
  exists (eigenvalue t s). split. exact Sum. split. exact Out. split. apply N. rewrite Inv. apply N.
Qed.

End Saddle.
