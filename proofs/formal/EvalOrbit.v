(** * The orbit in intervals

    The closed form of Asymmetric.v, the hits, the state at time 0 and the polynomials of the map,
    evaluated; each evaluation contains the number. *)

From Coq Require Import Reals Lra ZArith Bool List.
From Cap Require Import Statement Flight Jet Stages OneOne Asymmetric Symmetric Dip Orbit Numbers Moeckel Enclosure Data.
Import ListNotations.
Open Scope R_scope.

Section Evaluation.

Variable p : F.precision.
Notation ivp := (iv p).

Declare Scope iv_scope.
Notation "x + y" := (I.add p x y) : iv_scope.
Notation "x - y" := (I.sub p x y) : iv_scope.
Notation "x * y" := (I.mul p x y) : iv_scope.
Notation "x / y" := (I.div p x y) : iv_scope.
Notation "- x" := (I.neg x) : iv_scope.
Notation "# n" := (I.fromZ p n) (at level 5) : iv_scope.

(** ** The closed form *)

Record shape := { s_d : I.type; s_sin : I.type; s_cos : I.type;
                  s_S : I.type; s_C : I.type; s_W : I.type; s_phi : I.type }.

Definition fits (d S C W phi : R) (o : shape) : Prop :=
  inn d (s_d o) /\ inn (sin d) (s_sin o) /\ inn (cos d) (s_cos o) /\
  inn S (s_S o) /\ inn C (s_C o) /\ inn W (s_W o) /\ inn phi (s_phi o).

Section Closed.

Local Open Scope iv_scope.
Variables rho D : I.type.
Let pi := I.pi p.
Let sd := I.sin p D.
Let cd := I.cos p D.
Let sc := sd / D.

Definition eval_G : I.type := pi * pi / #2 * sc - #2 * cd - #2 * D * sd.

Definition eval_asymmetric (G : I.type) : shape :=
  let S := rho / G in
  let C := I.sqrt p (#1 - S * S) in
  {| s_d := D; s_sin := sd; s_cos := cd; s_S := S; s_C := C; s_W := pi / #2 * S * sc;
     s_phi := - I.atan p (S / C) |}.

Definition eval_friction : I.type :=
  let S := rho / eval_G in #2 / pi * cd * I.sqrt p (#1 - S * S).

Definition eval_friction' : I.type :=
  let G := eval_G in
  let G' := pi * pi / #2 * ((D * cd - sd) / (D * D)) - #2 * D * cd in
  let S := rho / G in
  let C := I.sqrt p (#1 - S * S) in
  #2 / pi * (cd * (S * (rho * G' / (G * G)) / C) - sd * C).

(** Around d = 0, where sin d/d is a value of the cosine. *)

Definition eval_G_near : I.type :=
  pi * pi / #2 * I.cos p (I.join #0 D) - #2 * cd - #2 * D * sd.

Variable f : I.type.

Definition eval_C_sym : I.type := pi * f / #2.

Definition eval_symmetric (s : Z) : shape :=
  let C := eval_C_sym in
  let S := #s * I.sqrt p (#1 - C * C) in
  {| s_d := #0; s_sin := #0; s_cos := #1; s_S := S; s_C := C; s_W := (rho + #2 * S) / pi;
     s_phi := - I.atan p (S / C) |}.

Definition eval_C_at : I.type := pi * f / (#2 * cd).

Definition eval_impossible (plus : bool) : bool :=
  let C := eval_C_at in
  let miss := I.sqrt p (#1 - C * C) * eval_G_near - rho in
  is_pos cd && if plus then is_pos miss || is_neg miss else is_nonneg eval_G_near.

End Closed.

Lemma inn_G : forall d D, inn d D -> inn (G d) (eval_G D).
Proof.
  intros d D H. unfold G, eval_G. replace (PI ^ 2 / 2) with (PI * PI / 2) by field. inn_auto.
Qed.

Lemma inn_friction : forall l r d rho D, inn (r - l) rho -> inn d D ->
  inn (friction l r d) (eval_friction rho D).
Proof.
  intros l r d rho D Hr Hd. assert (HG := inn_G d D Hd).
  unfold friction, C_of, S_of, eval_friction. inn_auto.
Qed.

Lemma inn_friction' : forall l r d rho D, inn (r - l) rho -> inn d D ->
  inn (friction' l r d) (eval_friction' rho D).
Proof.
  intros l r d rho D Hr Hd. assert (HG := inn_G d D Hd).
  unfold friction', C_of, S_of, G', eval_friction'. replace (PI ^ 2 / 2) with (PI * PI / 2) by field.
  cbv zeta. inn_auto.
Qed.

Lemma inn_asymmetric : forall l r d rho D, inn (r - l) rho -> inn d D ->
  fits d (S_of l r d) (C_of l r d) (W_of l r d) (phi_of l r d) (eval_asymmetric rho D (eval_G D)).
Proof.
  intros l r d rho D Hr Hd. assert (HG := inn_G d D Hd).
  assert (HS : inn (S_of l r d) (I.div p rho (eval_G D))) by (unfold S_of; inn_auto).
  unfold fits, eval_asymmetric, phi_of, angle_of, C_of, W_of.
  cbn [s_d s_sin s_cos s_S s_C s_W s_phi].
  repeat (lazymatch goal with |- _ /\ _ => split end); inn_auto.
Qed.

Lemma inn_symmetric : forall f l r rho Fi s, inn (r - l) rho -> inn f Fi ->
  fits 0 (S_sym f (IZR s)) (C_sym f) (W_sym f l r (IZR s)) (phi_sym f (IZR s))
    (eval_symmetric rho Fi s).
Proof.
  intros f l r rho Fi s Hr Hf.
  assert (HC : inn (C_sym f) (eval_C_sym Fi)) by (unfold C_sym, eval_C_sym; inn_auto).
  unfold fits, eval_symmetric, phi_sym, angle_of, W_sym, S_sym. cbv zeta.
  cbn [s_d s_sin s_cos s_S s_C s_W s_phi]. rewrite sin_0, cos_0.
  repeat (lazymatch goal with |- _ /\ _ => split end); inn_auto.
Qed.

Lemma impossible_ok : forall f l r d rho Fi D plus, inn (r - l) rho -> inn f Fi -> inn d D -> d <> 0 ->
  eval_impossible rho D Fi plus = true -> impossible f l r (if plus then 1 else -1) d.
Proof.
  intros f l r d rho Fi D plus Hr Hf Hd N H. unfold eval_impossible in H. cbv zeta in H.
  apply andb_prop in H. destruct H as [Hc H]. is_positive Hc (cos d).
  assert (HG : inn (G d) (eval_G_near D)).
  { destruct (sinc_is_cos d N) as [c [Hb E]].
    assert (Hi : inn c (I.join (I.fromZ p 0) D)) by (apply (inn_hull 0 c d); inn_auto).
    unfold G, eval_G_near. rewrite E. replace (PI ^ 2 / 2) with (PI * PI / 2) by field. inn_auto. }
  assert (HC : inn (C_at f d) (eval_C_at D Fi)) by (unfold C_at, eval_C_at; inn_auto).
  split. exact Hc. destruct plus.
  - split; [ | lra]. intros _ E. rewrite orb_true_iff in H. destruct H as [H | H].
    is_positive H (sqrt (1 - C_at f d * C_at f d) * G d - (r - l)). lra.
    apply is_neg_ok with (x := sqrt (1 - C_at f d * C_at f d) * G d - (r - l)) in H; [lra | inn_auto].
  - split; [lra | ]. intros _. is_nonnegative H (G d). exact H.
Qed.

(** ** The hits and the state *)

Definition ein (e : around R) (E : around I.type) : Prop :=
  inn (e_f e) (e_f E) /\ inn (e_l e) (e_l E) /\ inn (e_r e) (e_r E) /\ inn (e_T e) (e_T E) /\
  inn (e_x e) (e_x E) /\ inn (e_v e) (e_v E) /\
  inn (e_t1 e) (e_t1 E) /\ inn (e_sin1 e) (e_sin1 E) /\ inn (e_cos1 e) (e_cos1 E) /\
  inn (e_inv1 e) (e_inv1 E) /\
  inn (e_t2 e) (e_t2 E) /\ inn (e_sin2 e) (e_sin2 E) /\ inn (e_cos2 e) (e_cos2 E) /\
  inn (e_inv2 e) (e_inv2 E).

Section State.

Local Open Scope iv_scope.
Variables f l r : I.type.
Variable o : shape.

Definition eval_u1 : I.type := s_W o + f * s_d o.
Definition eval_u2 : I.type := s_W o - f * s_d o.

Definition eval_state : around I.type :=
  let pi := I.pi p in
  let t1 := s_phi o + pi / #2 - s_d o in
  let t2 := s_phi o + #3 * (pi / #2) + s_d o in
  let u2 := eval_u2 in
  let sin2 := - (s_C o * s_cos o + s_S o * s_sin o) in
  let cos2 := s_C o * s_sin o - s_S o * s_cos o in
  let rest := #2 * pi - t2 in
  Around f l r (#2 * pi)
    (l + u2 * rest - (#1 - cos2) - sin2 * rest - f * (rest * rest) / #2)
    (u2 - sin2 - f * rest)
    t1 (s_C o * s_cos o - s_S o * s_sin o) (s_S o * s_cos o + s_C o * s_sin o) (I.inv p eval_u1)
    t2 sin2 cos2 (I.inv p u2).

End State.

Lemma inn_state : forall f l r d S C W phi Fi L Ri o, inn f Fi -> inn l L -> inn r Ri ->
  closed f l r d S C W phi -> fits d S C W phi o ->
  ein (state f l r (hit1 d phi) (hit2 d phi) (speed1 f d W) (speed2 f d W)) (eval_state Fi L Ri o) /\
  inn (speed1 f d W) (eval_u1 Fi o) /\ inn (speed2 f d W) (eval_u2 Fi o).
Proof.
  intros f l r d S C W phi Fi L Ri o Hf Hl Hr Cl (H1 & H2 & H3 & H4 & H5 & H6 & H7).
  assert (S1 := sin_hit1 d S C phi (c_sin _ _ _ _ _ _ _ _ Cl) (c_cos _ _ _ _ _ _ _ _ Cl)).
  assert (C1 := cos_hit1 d S C phi (c_sin _ _ _ _ _ _ _ _ Cl) (c_cos _ _ _ _ _ _ _ _ Cl)).
  assert (S2 := sin_hit2 d S C phi (c_sin _ _ _ _ _ _ _ _ Cl) (c_cos _ _ _ _ _ _ _ _ Cl)).
  assert (C2 := cos_hit2 d S C phi (c_sin _ _ _ _ _ _ _ _ Cl) (c_cos _ _ _ _ _ _ _ _ Cl)).
  assert (U1 : inn (speed1 f d W) (eval_u1 Fi o)) by (unfold speed1, eval_u1; inn_auto).
  assert (U2 : inn (speed2 f d W) (eval_u2 Fi o)) by (unfold speed2, eval_u2; inn_auto).
  split; [ | split; assumption].
  unfold state, start_x, start_v, Flight.pos, Flight.vel. rewrite S1, C1, S2, C2, sin_2PI, cos_2PI.
  unfold hit1, hit2, ein, eval_state.
  cbn [e_f e_l e_r e_T e_x e_v e_t1 e_sin1 e_cos1 e_inv1 e_t2 e_sin2 e_cos2 e_inv2].
  repeat (lazymatch goal with |- _ /\ _ => split end); try solve [inn_auto].
  - set (rest := 2 * PI - (phi + 3 * (PI / 2) + d)).
    match goal with |- inn ?x _ => replace x with (l + speed2 f d W * rest - (1 - (C * sin d - S * cos d))
      - - (C * cos d + S * sin d) * rest - f * (rest * rest) / 2) by field end.
    unfold rest. inn_auto.
  - set (rest := 2 * PI - (phi + 3 * (PI / 2) + d)).
    match goal with |- inn ?x _ => replace x with
      (speed2 f d W - - (C * cos d + S * sin d) - f * rest) by ring end.
    unfold rest. inn_auto.
Qed.

(** ** The polynomials of the map *)

Ltac follow := repeat lazymatch goal with
  | |- jinn (jconst _ _) _ => apply jinn_const
  | |- jinn (ja _ _) _ => apply jinn_a
  | |- jinn (jb _ _) _ => apply jinn_b
  | |- jinn (jminus _ _ _) _ => apply jinn_minus
  | |- jinn (jplus _ _ _) _ => apply jinn_plus
  | |- jinn (jscal _ _ _) _ => apply jinn_scal
  | |- jinn (jmult _ _ _) _ => apply jinn_mult
  | |- jinn (jset _ _) _ => apply jinn_set
  | |- jinn (jsin _ _ _ _) _ => apply jinn_sin
  | |- jinn (jcos _ _ _ _) _ => apply jinn_cos
  | |- inn (add _ _ _) _ => apply inn_add
  | |- inn (mul _ _ _) _ => apply inn_mul
  | |- inn (neg _ _) _ => apply inn_neg
  | |- inn (div _ _ _) _ => apply inn_div
  | |- inn (of_Z _ _) _ => apply inn_Z
  end; auto.

Section Stages.

Variables (e : around R) (E : around I.type).
Hypothesis He : ein e E.

Ltac fields := destruct He as (? & ? & ? & ? & ? & ? & ? & ? & ? & ? & ? & ? & ? & ?).

Lemma step1_in : forall A B, jinn A B -> jinn (step1 R real e A) (step1 I.type ivp E B).
Proof. intros A B HA. fields. unfold step1, jg1. cbv zeta. follow. Qed.

Lemma speed1_in : forall A B, jinn A B -> jinn (jspeed1 R real e A) (jspeed1 I.type ivp E B).
Proof. intros A B HA. fields. unfold jspeed1. cbv zeta. follow. Qed.

Lemma step2_in : forall A U B A' U' B', jinn A A' -> jinn U U' -> jinn B B' ->
  jinn (step2 R real e A U B) (step2 I.type ivp E A' U' B').
Proof. intros A U B A' U' B' HA HU HB. fields. unfold step2, jg2. cbv zeta. follow. Qed.

Lemma speed2_in : forall A U B A' U' B', jinn A A' -> jinn U U' -> jinn B B' ->
  jinn (jspeed2 R real e A U B) (jspeed2 I.type ivp E A' U' B').
Proof. intros A U B A' U' B' HA HU HB. fields. unfold jspeed2. cbv zeta. follow. Qed.

Lemma final_in : forall B W B' W', jinn B B' -> jinn W W' ->
  jinn (final_x R real e B W) (final_x I.type ivp E B' W') /\
  jinn (final_v R real e B W) (final_v I.type ivp E B' W').
Proof.
  intros B W B' W' HB HW. fields. split. unfold final_x. cbv zeta. follow.
  unfold final_v. cbv zeta. follow.
Qed.

Theorem jmap_in : jinn (fst (jmap real e)) (fst (jmap ivp E)) /\
                  jinn (snd (jmap real e)) (snd (jmap ivp E)).
Proof.
  assert (HA : jinn (jt1 R real e) (jt1 I.type ivp E)).
  { unfold jt1. do 3 apply step1_in. apply jinn_const. fields. assumption. }
  assert (HU := speed1_in _ _ HA).
  assert (HB : jinn (jt2 R real e (jt1 R real e) (jspeed1 R real e (jt1 R real e)))
    (jt2 I.type ivp E (jt1 I.type ivp E) (jspeed1 I.type ivp E (jt1 I.type ivp E)))).
  { unfold jt2. do 3 (apply step2_in; [assumption | assumption | ]). apply jinn_const. fields.
    assumption. }
  assert (HW := speed2_in _ _ _ _ _ _ HA HU HB).
  exact (final_in _ _ _ _ HB HW).
Qed.

End Stages.

(** ** The twist *)

Definition pinn (x : R * R) (X : I.type * I.type) : Prop := inn (fst x) (fst X) /\ inn (snd x) (snd X).

Lemma moeckel_in : forall jx jv cs sn wr wi JX JV CS SN WR WI, jinn jx JX -> jinn jv JV ->
  inn cs CS -> inn sn SN -> inn wr WR -> inn wi WI ->
  inn (moeckel real jx jv cs sn wr wi) (moeckel ivp JX JV CS SN WR WI).
Proof.
  intros jx jv cs sn wr wi JX JV CS SN WR WI Hx Hv Hcs Hsn Hwr Hwi.
  assert (Plus : forall x y X Y, pinn x X -> pinn y Y -> pinn (cplus R real x y) (cplus I.type ivp X Y)).
  { intros x y X Y [A B] [C D]. split; apply inn_add; assumption. }
  assert (Mult : forall x y X Y, pinn x X -> pinn y Y -> pinn (cmult R real x y) (cmult I.type ivp X Y)).
  { intros x y X Y [A B] [C D]. split; apply inn_add; try apply inn_neg; apply inn_mul; assumption. }
  assert (Bar : forall x X, pinn x X -> pinn (cbar R real x) (cbar I.type ivp X)).
  { intros x X [A B]. split. exact A. apply inn_neg, B. }
  assert (Scal : forall k x X, pinn x X -> pinn (cscal R real k x) (cscal I.type ivp k X)).
  { intros k x X [A B]. split; apply inn_mul; try apply inn_Z; assumption. }
  assert (Norm : forall x X, pinn x X -> inn (cnorm R real x) (cnorm I.type ivp X)).
  { intros x X [A B]. apply inn_add; apply inn_mul; assumption. }
  destruct Hx as (X0 & X1 & X2 & X3 & X4 & X5 & X6 & X7 & X8 & X9).
  destruct Hv as (V0 & V1 & V2 & V3 & V4 & V5 & V6 & V7 & V8 & V9).
  assert (Term : forall x v X V, inn x X -> inn v V ->
    pinn (cmult R real (cs, neg real sn) (add real x (mul real wr v), mul real wi v))
         (cmult I.type ivp (CS, neg ivp SN) (add ivp X (mul ivp WR V), mul ivp WI V))).
  { intros x v X V A B. apply Mult; split; cbn [fst snd]. exact Hcs. apply inn_neg, Hsn.
    apply inn_add. exact A. apply inn_mul; assumption. apply inn_mul; assumption. }
  assert (Al : pinn (div real (of_Z real 1) (of_Z real 2), div real wr (mul real (of_Z real 2) wi))
    (div ivp (of_Z ivp 1) (of_Z ivp 2), div ivp WR (mul ivp (of_Z ivp 2) WI))).
  { split; cbn [fst snd]. apply inn_div; apply inn_Z.
    apply inn_div. exact Hwr. apply inn_mul. apply inn_Z. exact Hwi. }
  assert (Be : pinn (of_Z real 0, div real (of_Z real (-1)) (mul real (of_Z real 2) wi))
    (of_Z ivp 0, div ivp (of_Z ivp (-1)) (mul ivp (of_Z ivp 2) WI))).
  { split; cbn [fst snd]. apply inn_Z. apply inn_div. apply inn_Z. apply inn_mul. apply inn_Z. exact Hwi. }
  assert (F2 : forall x y X Y, pinn x X -> pinn y Y ->
    pinn (form2 R real jx jv cs sn wr wi x y) (form2 I.type ivp JX JV CS SN WR WI X Y)).
  { intros x y X Y A B. unfold form2. cbv zeta.
    apply Plus. apply Mult. apply Term; assumption. apply Mult; assumption.
    apply Plus. apply Mult. apply Term; assumption. apply Mult; assumption.
    apply Mult. apply Term; assumption. apply Mult; assumption. }
  assert (F21 : pinn (form21 R real jx jv cs sn wr wi) (form21 I.type ivp JX JV CS SN WR WI)).
  { unfold form21. cbv zeta.
    apply Plus. apply Mult. apply Term; assumption. auto 10.
    apply Plus. apply Mult. apply Term; assumption. auto 10.
    apply Plus. apply Mult. apply Term; assumption. auto 10.
    apply Mult. apply Term; assumption. auto 10. }
  unfold moeckel. cbv zeta.
  apply inn_mul. exact Hwi. apply inn_add. apply F21.
  apply inn_add; apply inn_mul; try apply inn_Z; try apply inn_mul; auto;
    repeat first [apply inn_div | apply inn_mul | apply inn_add | apply inn_Z | assumption].
Qed.

End Evaluation.
