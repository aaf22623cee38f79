(** * The checker is right: if its tests succeed, the theorems hold with these numbers *)

From Coq Require Import Reals Lra Lia ZArith Bool List.
From Coquelicot Require Import Coquelicot.
From Cap Require Import Statement Flight Jet Symplectic Stages Image OneOne Asymmetric Orbit Box Numbers
  Elliptic Saddle Units Enclosure Data EvalOrbit Check CheckedUnits CheckedBox CheckedOrbit CheckedMap.
Open Scope R_scope.

Section Checked.

Variables (n : orbit_data) (h : hints).
Variable tests_more : around I.type -> jet I.type * jet I.type -> list (test * bool).
Hypothesis checks : passed (tests_with n h tests_more) = true.

Notation p := (Enclosure.F.PtoP (bits h)).
Definition o : shape := the_shape n h.
Definition s : around I.type := eval_state p (scaled_f n p) (scaled_l n p) (scaled_r n p) o.

Lemma split_checks : forallb snd (orbit_tests n h o s) = true /\
  passed (trace_tests n h (jmap (iv p) s)) = true /\ passed (tests_more s (jmap (iv p) s)) = true /\
  forallb snd (box_tests n h) = true.
Proof.
  assert (H := checks). unfold passed, tests_with in H. cbv zeta in H. fold o in H. fold s in H.
  rewrite !forallb_app, !andb_true_iff in H. exact H.
Qed.

Lemma good_parameters : good n.
Proof. exact (parameters_ok n h o s (proj1 split_checks)). Qed.

(** [more] follows from the tests about it. *)

Variable more : (R -> R -> R) -> (R -> R -> R) -> R -> R -> jet R -> jet R -> Prop.
Hypothesis more_ok : forall x v jx jv X V, good n -> inn x (e_x s) -> inn v (e_v s) ->
  jinn jx (fst (jmap (iv p) s)) -> jinn jv (snd (jmap (iv p) s)) ->
  map_known (f n) (l n) (r n) x v jx jv X V -> more X V x v jx jv.

Theorem orbit_checked : orbit_with 1 1 (f n) (l n) (r n) (the_claims n) more.
Proof.
  destruct split_checks as (To & Tt & _ & Tb).
  assert (ok := good_parameters).
  assert (W := walls n ok). assert (Sm := f_small n ok).
  destruct (orbit_exists n h o s To) as (d & S & C & V & phi & Eq & Fit). fold o in Fit.
  destruct (inn_state p (f n) (l n) (r n) d S C V phi _ _ _ o (inn_f n p) (inn_l n p) (inn_r n p) Eq Fit)
    as (St & U1 & U2).
  change (eval_state p (scaled_f n p) (scaled_l n p) (scaled_r n p) o) with s in St.
  assert (Cl := sufficient (f n) (l n) (r n) d S C V phi Eq).
  set (t1 := hit1 d phi) in *. set (t2 := hit2 d phi) in *.
  set (u1 := speed1 (f n) d V) in *. set (u2 := speed2 (f n) d V) in *. clearbody t1 t2 u1 u2.
  destruct (jmap_in p _ _ St) as [Jx Jv].
  rewrite (surjective_pairing (jmap (iv p) s)) in Tt.
  assert (Tr := trace_ok n h _ _ _ _ Jx Jv Tt).
  destruct St as (_ & _ & _ & _ & X0 & V0 & T1 & Sin1 & Cos1 & _ & T2 & Sin2 & Cos2 & _).
  cbn [state e_x e_v e_t1 e_sin1 e_cos1 e_t2 e_sin2 e_cos2] in X0, V0, T1, Sin1, Cos1, T2, Sin2, Cos2.
  assert (Ord := order_ok n h o s To t1 t2 T1 T2).
  destruct (least_ok n h o s To t1 t2 u1 u2 T1 Sin1 T2 Sin2 U1 U2 Cl) as (Lp & Slow & Fast).
  destruct (claims_ok n h o s To t1 t2 u1 u2 _ _ T1 Cos1 T2 Cos2 U1 U2 X0 V0)
    as [K1 K2 K3 K4 K5 K6 K7 K8].
  assert (ImP : image 1 1 (f n) (l n) (r n) 1 (start_x (f n) (l n) t2 u2) (start_v (f n) t2 u2)
    (start_x (f n) (l n) t2 u2) (start_v (f n) t2 u2)).
  { destruct (speeds_above (f n) (l n) (r n) Sm t1 t2 u1 u2 Cl Ord _ Slow) as [Bk Fo].
    assert (Ord3 : 0 < t1 /\ t1 < t2 /\ t2 < 2 * PI) by lra.
    assert (Ps := orbit_passes (f n) (l n) (r n) t1 t2 u1 u2 _ Ord3 Cl Lp Bk Fo).
    assert (Im := passes_image (f n) (l n) (r n) W _ _ _ _ Ps).
    destruct (orbit_returns (f n) (l n) (r n) t1 t2 u1 u2 Cl) as [E1 E2]. rewrite E1, E2 in Im. exact Im. }
  apply (orbit_of_numbers (f n) (l n) (r n) W Sm t1 t2 u1 u2 Cl Ord).
  2: { intros A B M. apply more_ok; assumption. }
  split; try assumption.
  intros a b Ha Hb. assert (K := box_known n h ok Tb a b Ha Hb).
  split. exact (known_image (f n) (l n) (r n) W a b _ _ _ _ K).
  intros Im. apply (fixed_unique (f n) (l n) (r n) W
    (fun a b => within (box_x (the_claims n)) a /\ within (box_v (the_claims n)) b)
    _ _ _ _ (one_in_the_box n h ok Tb) (fun a b H => box_known n h ok Tb a b (proj1 H) (proj2 H))); auto.
Qed.

End Checked.

Theorem elliptic_checked : forall (n : elliptic_data) (h : hints), passed (elliptic_tests n h) = true ->
  elliptic_orbit (value (F_ n)) (value (w_ n)) (value (f_ n)) (value (l_ n)) (value (r_ n)) (elliptic_claims_of n).
Proof.
  intros n h H. assert (ok := good_parameters n h _ H). destruct (split_checks n h _ H) as (_ & _ & Tm & _).
  apply (elliptic_in_given_units n ok), (orbit_checked n h _ H).
  intros x v jx jv X V _ _ _ Jx Jv M. rewrite (surjective_pairing (jmap _ _)) in Tm.
  apply (elliptic_of_numbers (f n) (l n) (r n) x v jx jv _ _ X V (elliptic_ok n h ok jx jv _ _ Jx Jv Tm)), M.
Qed.

Theorem saddle_checked : forall (n : saddle_data) (h : hints), passed (saddle_tests n h) = true ->
  saddle_orbit (value (F_ n)) (value (w_ n)) (value (f_ n)) (value (l_ n)) (value (r_ n)) (saddle_claims_of n).
Proof.
  intros n h H. assert (ok := good_parameters n h _ H). destruct (split_checks n h _ H) as (_ & _ & Tm & _).
  apply (saddle_in_given_units n ok), (orbit_checked n h _ H).
  intros x v jx jv X V _ Ix Iv Jx Jv _. rewrite (surjective_pairing (jmap _ _)) in Tm.
  exact (saddle_of_numbers x v jx jv _ _ X V (saddle_ok n h ok x v _ _ jx jv _ _ Ix Iv Jx Jv Tm)).
Qed.
