(** * The tests of the map say what is claimed of it: elliptic, with its twist, or a saddle *)

From Coq Require Import Reals Lra Lia ZArith Bool List.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Jet Elliptic Saddle Units Moeckel Enclosure Data EvalOrbit Check CheckedUnits.
Open Scope R_scope.

Section Map.

Variables (n : elliptic_data) (h : hints).
Hypothesis ok : good n.
Variables (jx jv : jet R) (JX JV : jet I.type).
Hypothesis in_jx : jinn jx JX.
Hypothesis in_jv : jinn jv JV.
Hypothesis tested : passed (elliptic_type h n (JX, JV)) = true.

Notation p := (Enclosure.F.PtoP (bits h)).
Notation the_elliptic_claims := (elliptic_in_units (lambda n) (w n) (elliptic_claims_of n)).
Let cs : R := (c10 jx + c01 jv) / 2.

Definition sign_of : R := IZR (if is_pos (c10 JV) then 1 else -1).
Let root : R := sqrt (1 - cs * cs).
Let tau : R := moeckel real jx jv cs (sign_of * root) ((cs - c10 jx) / c10 jv) (sign_of * root / c10 jv).

Lemma elliptic_ok : elliptic_numbers jx jv sign_of the_elliptic_claims.
Proof.
  assert (Hl := lambda_pos n ok). assert (HU := U_pos n ok).
  assert (InU := inn_U n p). assert (InL := inn_lam n p). assert (Pi := inn_PI p).
  assert (LI := inn_inv p _ _ InL). assert (UI := inn_inv p _ _ InU).
  assert (Li0 : 0 < / lambda n) by (apply Rinv_0_lt_compat; exact Hl).
  assert (Ui0 : 0 < / U n) by (apply Rinv_0_lt_compat; exact HU).
  assert (LU0 : 0 < / (lambda n * U n)) by (apply Rinv_0_lt_compat, Rmult_lt_0_compat; assumption).
  assert (H := tested). unfold passed, elliptic_type in H. cbv zeta in H. cbn [forallb fst snd] in H.
  rewrite !andb_true_iff in H.
  destruct H as (Tx & Tv & [El1 El2] & [Re3 Re4] & Tc & Ta & Tr & Tw & T0 & _).
  assert (Ia : inn (c10 jx) (c10 JX)) by exact (proj1 (proj2 in_jx)).
  assert (Id : inn (c01 jv) (c01 JV)) by exact (proj1 (proj2 (proj2 in_jv))).
  assert (Ic : inn (c10 jv) (c10 JV)) by exact (proj1 (proj2 in_jv)).
  set (CS := I.div p (I.add p (c10 JX) (c01 JV)) (I.fromZ p 2)) in *.
  assert (Ics : inn cs CS) by (unfold cs, CS; inn_auto). clearbody CS.
  set (ROOT := I.sqrt p (I.sub p (I.fromZ p 1) (I.mul p CS CS))) in *.
  assert (Ir : inn root ROOT) by (unfold root, ROOT; inn_auto).
  set (SIGN := I.fromZ p (if is_pos (c10 JV) then 1 else -1)) in *.
  assert (Isg : inn sign_of SIGN) by apply inn_Z.
  assert (Ith : inn (angle_at cs) (I.sub p (I.div p (I.pi p) (I.fromZ p 2)) (I.atan p (I.div p CS ROOT))))
    by (unfold angle_at; fold root; inn_auto).
  assert (Itau : inn tau (moeckel (iv p) JX JV CS (I.mul p SIGN ROOT) (I.div p (I.sub p CS (c10 JX)) (c10 JV))
      (I.div p (I.mul p SIGN ROOT) (c10 JV)))).
  { unfold tau. apply moeckel_in; auto; inn_auto. }
  is_positive El1 (1 - cs). is_positive El2 (cs + 1).
  split; cbv zeta; fold cs.
  - exact (inside_jet_ok p (lambda n) (/ lambda n) (/ U n) jx _ _ _ _ _ Hl Li0 Ui0 InL LI UI in_jx Tx).
  - exact (inside_jet_ok p (U n) (/ lambda n) (/ U n) jv _ _ _ _ _ HU Li0 Ui0 InU LI UI in_jv Tv).
  - lra.
  - apply orb_prop in Re3. destruct Re3 as [Re3 | Re3].
    is_positive Re3 (2 * cs + 1). lra. apply is_neg_ok with (x := 2 * cs + 1) in Re3; [lra | inn_auto].
  - apply orb_prop in Re4. destruct Re4 as [Re4 | Re4].
    is_positive Re4 cs. lra. apply is_neg_ok with (x := cs) in Re4; [lra | inn_auto].
  - unfold sign_of. destruct (is_pos (c10 JV)) eqn:E.
    + apply is_pos_ok with (1 := Ic) in E. split; lra.
    + rewrite orb_false_l in Tc. apply is_neg_ok with (1 := Ic) in Tc. split; lra.
  - exact (inside_1_ok p _ _ _ (inn_mul p _ _ _ _ Isg Ith) Ta).
  - exact (inside_1_ok p _ _ _ (inn_div p _ _ _ _ Ith (inn_mul p _ _ _ _ (inn_Z p 2) Pi)) Tr).
  - exact (inside_ok p _ _ _ _ _ LU0 (inn_inv p _ _ (inn_mul p _ _ _ _ InL InU)) Itau Tw).
  - change (tau <> 0). apply orb_prop in T0. destruct T0 as [T0 | T0].
    apply is_pos_ok with (1 := Itau) in T0. lra. apply is_neg_ok with (1 := Itau) in T0. lra.
Qed.

End Map.

(** The trace. *)

Lemma trace_ok : forall (n : orbit_data) (h : hints) jx jv JX JV, jinn jx JX -> jinn jv JV ->
  passed (trace_tests n h (JX, JV)) = true -> within (trace (the_claims n)) (c10 jx + c01 jv).
Proof.
  intros n h jx jv JX JV (_ & Ia & _) (_ & _ & Id & _) H. unfold passed, trace_tests in H.
  cbn [forallb fst snd] in H. rewrite andb_true_r in H.
  exact (inside_1_ok _ _ _ _ (inn_add _ _ _ _ _ Ia Id) H).
Qed.

(** A saddle. *)

Section Saddle.

Variables (n : saddle_data) (h : hints).
Hypothesis ok : good n.
Variables (x v : R) (X V : I.type) (jx jv : jet R) (JX JV : jet I.type).
Hypothesis in_x : inn x X.
Hypothesis in_v : inn v V.
Hypothesis in_jx : jinn jx JX.
Hypothesis in_jv : jinn jv JV.
Hypothesis tested : passed (saddle_type h n X V (JX, JV)) = true.

Notation p := (Enclosure.F.PtoP (bits h)).
Notation the_saddle_claims := (saddle_in_units (lambda n) (w n) (saddle_claims_of n)).

Definition sign_of_trace : R := IZR (if is_pos (I.add p (c10 JX) (c01 JV)) then 1 else -1).

Lemma saddle_ok : saddle_numbers x v jx jv sign_of_trace the_saddle_claims.
Proof.
  assert (Hl := lambda_pos n ok). assert (HU := U_pos n ok). assert (Hw := w_pos n ok).
  assert (InU := inn_U n p). assert (InL := inn_lam n p). assert (Inw := inn_num p (w_ n)).
  assert (Wi : 0 < / w n) by (apply Rinv_0_lt_compat; exact Hw).
  assert (H := tested). unfold passed, saddle_type in H. cbv zeta in H. cbn [forallb fst snd] in H.
  rewrite !andb_true_iff in H.
  destruct H as ([Sx Sv] & [[[D1 D2] D3] D4] & Out & Mo & Mi & _).
  destruct in_jx as (_ & Ia & Ib & _). destruct in_jv as (_ & Ic & Id & _).
  fold (num p (w_ n)) in *.
  set (TR := I.add p (c10 JX) (c01 JV)) in *. set (t := c10 jx + c01 jv).
  assert (It : inn t TR) by (unfold t, TR; inn_auto).
  set (SIGN := I.fromZ p (if is_pos TR then 1 else -1)) in *.
  assert (Isg : inn sign_of_trace SIGN) by apply inn_Z.
  assert (Iroot : inn (sqrt (t * t - 4)) (I.sqrt p (I.sub p (I.mul p TR TR) (I.fromZ p 4)))) by inn_auto.
  is_positive Out (sign_of_trace * t - 2).
  split.
  - split. exact (inside_ok p _ _ _ _ _ Hl InL in_x Sx). exact (inside_ok p _ _ _ _ _ HU InU in_v Sv).
  - split. exact (inside_1_ok p _ _ _ Ia D1).
    split. exact (inside_ok p _ _ _ _ _ Wi (inn_inv p _ _ Inw) Ib D2).
    split. exact (inside_ok p _ _ _ _ _ Hw Inw Ic D3). exact (inside_1_ok p _ _ _ Id D4).
  - split. unfold sign_of_trace. destruct (is_pos _); [left | right]; reflexivity. fold t. lra.
  - apply (inside_1_ok p) with (2 := Mo). unfold eigenvalue. fold t. inn_auto.
  - apply (inside_1_ok p) with (2 := Mi). unfold eigenvalue. fold t. inn_auto.
Qed.

End Saddle.
