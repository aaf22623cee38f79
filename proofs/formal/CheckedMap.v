(** * The tests of the map say what is claimed of its polynomials, its type and its twist *)

From Coq Require Import Reals Lra Lia ZArith Bool List.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Jet Elliptic Units Moeckel Enclosure Data EvalOrbit Check CheckedUnits.
Open Scope R_scope.

Section Map.

Variables (n : data) (h : hints).
Hypothesis ok : good n.
Variables (jx jv : jet R) (JX JV : jet I.type).
Hypothesis in_jx : jinn jx JX.
Hypothesis in_jv : jinn jv JV.
Hypothesis tested : forallb snd (map_tests n h (JX, JV)) = true.

Notation p := (Enclosure.F.PtoP (bits h)).
Let cs : R := (c10 jx + c01 jv) / 2.

Definition sign_of : R := IZR (if is_pos (c10 JV) then 1 else -1).
Let root : R := sqrt (1 - cs * cs).
Let tau : R := moeckel real jx jv cs (sign_of * root) ((cs - c10 jx) / c10 jv) (sign_of * root / c10 jv).

Record map_claims : Prop := {
  k_jx : within_jet (taylor_x (the_claims n)) jx;
  k_jv : within_jet (taylor_v (the_claims n)) jv;
  k_trace : within (trace (the_claims n)) (c10 jx + c01 jv);
  k_elliptic : -1 < cs < 1;
  k_not_3 : 2 * cs + 1 <> 0;
  k_not_4 : cs <> 0;
  k_sign : sign_of * sign_of = 1 /\ 0 < sign_of * c10 jv;
  k_angle : within (angle (the_claims n)) (sign_of * angle_at cs);
  k_rotation : within (rotation (the_claims n)) (angle_at cs / (2 * PI));
  k_twist : within (twist (the_claims n)) tau;
  k_twist_not_0 : tau <> 0 }.

Lemma map_ok : map_claims.
Proof.
  assert (Hl := lambda_pos n ok). assert (HU := U_pos n ok).
  assert (InU := inn_U n p). assert (InL := inn_lam n p). assert (Pi := inn_PI p).
  assert (LI := inn_inv p _ _ InL). assert (UI := inn_inv p _ _ InU).
  assert (Li0 : 0 < / lambda n) by (apply Rinv_0_lt_compat; exact Hl).
  assert (Ui0 : 0 < / U n) by (apply Rinv_0_lt_compat; exact HU).
  assert (LU0 : 0 < / (lambda n * U n)) by (apply Rinv_0_lt_compat, Rmult_lt_0_compat; assumption).
  assert (H := tested). unfold map_tests in H. cbv zeta in H. cbn [forallb fst snd] in H.
  rewrite !andb_true_iff in H.
  destruct H as (Tx & Tv & Tt & [El1 El2] & [Re3 Re4] & Tc & Ta & Tr & Tw & T0 & _).
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
  split.
  - exact (inside_jet_ok p (lambda n) (/ lambda n) (/ U n) jx _ _ _ _ _ Hl Li0 Ui0 InL LI UI in_jx Tx).
  - exact (inside_jet_ok p (U n) (/ lambda n) (/ U n) jv _ _ _ _ _ HU Li0 Ui0 InU LI UI in_jv Tv).
  - exact (inside_1_ok p _ _ _ (inn_add p _ _ _ _ Ia Id) Tt).
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
  - apply orb_prop in T0. destruct T0 as [T0 | T0].
    apply is_pos_ok with (1 := Itau) in T0. lra. apply is_neg_ok with (1 := Itau) in T0. lra.
Qed.

End Map.
