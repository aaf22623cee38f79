(** * The checker in units F = w = 1

    The numbers of a certificate are in any units; the tests compare them with k x, x computed in units
    F = w = 1, and say where x lies. *)

From Coq Require Import Reals Lra Lia ZArith Bool List.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Jet Units Enclosure Data Check.
Open Scope R_scope.

(** Lengths in units F/w^2, times in 1/w, speeds in F/w, forces in F. *)

Section Units.

Variable n : orbit_data.

Definition F : R := value (F_ n).
Definition w : R := value (w_ n).
Definition lambda : R := F / (w * w).
Definition U : R := lambda * w.
Definition f : R := value (f_ n) / F.
Definition l : R := value (l_ n) / lambda.
Definition r : R := value (r_ n) / lambda.

Definition the_claims : orbit_claims := orbit_in_units lambda w (orbit_claims_of n).

(** ** In intervals *)

Section Precision.

Variable p : Enclosure.F.precision.

Lemma inn_lam : inn lambda (lam n p).
Proof.
  unfold lambda, lam, F, w. apply inn_div. apply inn_num. apply inn_mul; apply inn_num.
Qed.

Lemma inn_U : inn U (unit_U n p).
Proof. unfold U, w. apply inn_mul. apply inn_lam. apply inn_num. Qed.

Lemma inn_f : inn f (scaled_f n p).
Proof. unfold f, F. apply inn_div; apply inn_num. Qed.

Lemma inn_l : inn l (scaled_l n p).
Proof. unfold l. apply inn_div. apply inn_num. apply inn_lam. Qed.

Lemma inn_r : inn r (scaled_r n p).
Proof. unfold r. apply inn_div. apply inn_num. apply inn_lam. Qed.

Lemma inn_rho : inn (r - l) (scaled_rho n p).
Proof. apply inn_sub. apply inn_r. apply inn_l. Qed.

Lemma inside_ok : forall k x K X c, 0 < k -> inn k K -> inn x X -> inside p K c X = true ->
  within (shrunk k (interval_of c)) x.
Proof.
  intros k x K X c Hk HK HX H. apply within_shrunk. exact Hk. unfold inside in H. cbv zeta in H.
  apply andb_prop in H. destruct H as [H1 H2]. assert (Y := inn_mul p _ _ _ _ HK HX).
  apply is_nonneg_ok with (1 := inn_sub p _ _ _ _ Y (inn_num p (fst c))) in H1.
  apply is_nonneg_ok with (1 := inn_sub p _ _ _ _ (inn_num p (snd c)) Y) in H2.
  unfold within, interval_of. simpl. lra.
Qed.

Lemma inside_1_ok : forall x X c, inn x X -> inside p (I.fromZ p 1) c X = true -> within (interval_of c) x.
Proof.
  intros x X c HX H. assert (W := inside_ok 1 x _ X c Rlt_0_1 (inn_Z p 1) HX H).
  apply within_shrunk in W. rewrite Rmult_1_l in W. exact W. lra.
Qed.

Lemma inside_jet_ok : forall k a b j K A B J c, 0 < k -> 0 < a -> 0 < b -> inn k K -> inn a A -> inn b B ->
  jinn j J -> inside_jet p K A B c J = true ->
  within_jet (jet_shrunk k a b (jet_map interval_of c)) j.
Proof.
  intros k a b j K A B J c Hk Ha Hb HK HA HB (J0 & J1 & J2 & J3 & J4 & J5 & J6 & J7 & J8 & J9) H.
  assert (P : forall x y, 0 < x -> 0 < y -> 0 < x * y) by (intros; apply Rmult_lt_0_compat; assumption).
  unfold inside_jet in H. cbv zeta in H. rewrite !andb_true_iff in H.
  destruct H as [[[[[[[[[H0 H1] H2] H3] H4] H5] H6] H7] H8] H9].
  unfold within_jet, jet_shrunk, jet_map. cbn [c00 c10 c01 c20 c11 c02 c30 c21 c12 c03].
  repeat (lazymatch goal with |- _ /\ _ => split end);
    [ exact (inside_ok _ _ _ _ _ Hk HK J0 H0) | .. ];
    eapply inside_ok; try eassumption; auto with inn.
Qed.

End Precision.

(** What the test of the parameters says. *)

Record good : Prop := {
  F_pos : 0 < F; w_pos : 0 < w; f_small : 0 < f < 1; walls : l < r }.

Hypothesis parameters_good : good.

Lemma lambda_pos : 0 < lambda.
Proof. destruct parameters_good. apply Rdiv_lt_0_compat; nra. Qed.

Lemma U_pos : 0 < U.
Proof. apply Rmult_lt_0_compat. apply lambda_pos. apply parameters_good. Qed.

Lemma units_back : lambda * w * w * 1 = value (F_ n) /\ w * 1 = value (w_ n) /\
  lambda * w * w * f = value (f_ n) /\ lambda * l = value (l_ n) /\ lambda * r = value (r_ n).
Proof.
  destruct parameters_good as [HF Hw _ _]. assert (Hl := lambda_pos).
  assert (E1 : lambda * w * w = F) by (unfold lambda; field; lra).
  rewrite E1. fold F w. unfold f, l, r.
  split. ring. split. ring. split. field. lra. split; field; lra.
Qed.

End Units.

Theorem elliptic_in_given_units : forall n : elliptic_data, good n ->
  orbit_with 1 1 (f n) (l n) (r n) (the_claims n)
    (elliptic 1 1 (f n) (l n) (r n) (elliptic_in_units (lambda n) (w n) (elliptic_claims_of n))) ->
  elliptic_orbit (value (F_ n)) (value (w_ n)) (value (f_ n)) (value (l_ n)) (value (r_ n)) (elliptic_claims_of n).
Proof.
  intros n ok E. assert (Hl := lambda_pos n ok). assert (Hw := w_pos n ok).
  assert (H := orbit_scaled (lambda n) (w n) Hl Hw _ _ _ _ _ _
    (elliptic_scales (lambda n) (w n) Hl Hw (f n) (l n) (r n) (elliptic_claims_of n)) E).
  destruct (units_back n ok) as (E1 & E2 & E3 & E4 & E5). rewrite E1, E2, E3, E4, E5 in H. exact H.
Qed.

Theorem saddle_in_given_units : forall n : saddle_data, good n ->
  orbit_with 1 1 (f n) (l n) (r n) (the_claims n) (saddle (saddle_in_units (lambda n) (w n) (saddle_claims_of n))) ->
  saddle_orbit (value (F_ n)) (value (w_ n)) (value (f_ n)) (value (l_ n)) (value (r_ n)) (saddle_claims_of n).
Proof.
  intros n ok E. assert (Hl := lambda_pos n ok). assert (Hw := w_pos n ok).
  assert (H := orbit_scaled (lambda n) (w n) Hl Hw _ _ _ _ _ _
    (saddle_scales (lambda n) (w n) Hl Hw (f n) (l n) (r n) (saddle_claims_of n)) E).
  destruct (units_back n ok) as (E1 & E2 & E3 & E4 & E5). rewrite E1, E2, E3, E4, E5 in H. exact H.
Qed.
