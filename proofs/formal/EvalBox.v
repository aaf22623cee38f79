(** * The box in intervals: cell after cell

    On a cell of states the hits lie in given windows W; the mean value theorem around their middles
    m narrows them, s in m + (r - x(m))/v(W).  Then the speeds of Box.v are evaluated. *)

From Coq Require Import Reals Lra Lia ZArith Bool.
From Coquelicot Require Import Coquelicot.
From Interval.Real Require Import Xreal.
From Interval.Interval Require Import Interval Float_full.
From Cap Require Import Statement Flight Plane Hits Image OneOne Asymmetric Dip Orbit Box Enclosure Data
  EvalOrbit.
Open Scope R_scope.

(** ** Cutting an interval into n equal parts *)

Definition edge (a b : R) (n i : nat) : R := a + (b - a) * INR i / INR n.

Lemma edges_cover : forall a b n x, (0 < n)%nat -> a <= x <= b ->
  exists i, (i < n)%nat /\ edge a b n i <= x <= edge a b n (S i).
Proof.
  intros a b n x Hn Hx. assert (N : 0 < INR n) by (apply lt_0_INR; exact Hn).
  assert (Main : forall k, (0 < k)%nat -> x <= edge a b n k ->
    exists i, (i < k)%nat /\ edge a b n i <= x <= edge a b n (S i)).
  { induction k as [ | k IH]. lia. intros _ H.
    destruct (Rle_dec x (edge a b n k)) as [L | L].
    - destruct (Nat.eq_dec k 0) as [-> | K].
      + exists 0%nat. split. lia. split. 2: exact H. unfold edge. simpl. unfold Rdiv. lra.
      + destruct (IH ltac:(lia) L) as [i [Hi E]]. exists i. split. lia. exact E.
    - exists k. split. lia. lra. }
  apply Main. exact Hn. unfold edge. unfold Rdiv. rewrite Rmult_assoc, Rinv_r by lra. lra.
Qed.

Fixpoint all_below (n : nat) (test : nat -> bool) : bool :=
  match n with 0%nat => true | S k => test k && all_below k test end.

Lemma all_below_ok : forall n test i, all_below n test = true -> (i < n)%nat -> test i = true.
Proof.
  induction n as [ | n IH]; intros test i H Hi. lia. simpl in H. apply andb_prop in H.
  destruct (Nat.eq_dec i n) as [-> | N]. apply H. apply IH. apply H. lia.
Qed.

Section Evaluation.

Variable p : F.precision.

Declare Scope iv_scope.
Notation "x + y" := (I.add p x y) : iv_scope.
Notation "x - y" := (I.sub p x y) : iv_scope.
Notation "x * y" := (I.mul p x y) : iv_scope.
Notation "x / y" := (I.div p x y) : iv_scope.
Notation "- x" := (I.neg x) : iv_scope.
Notation "# n" := (I.fromZ p n) (at level 5) : iv_scope.

Definition part (c : range) (n i : nat) : I.type :=
  let a := num p (fst c) in let b := num p (snd c) in
  let e i := I.add p a (I.div p (I.mul p (I.sub p b a) (I.fromZ p (Z.of_nat i))) (I.fromZ p (Z.of_nat n))) in
  I.join (e i) (e (S i)).

Lemma part_ok : forall c n i x,
  edge (value (fst c)) (value (snd c)) n i <= x <= edge (value (fst c)) (value (snd c)) n (S i) ->
  inn x (part c n i).
Proof.
  intros c n i x H. assert (A := inn_num p (fst c)). assert (B := inn_num p (snd c)).
  assert (E : forall i, inn (edge (value (fst c)) (value (snd c)) n i)
    (I.add p (num p (fst c)) (I.div p (I.mul p (I.sub p (num p (snd c)) (num p (fst c)))
      (I.fromZ p (Z.of_nat i))) (I.fromZ p (Z.of_nat n))))).
  { intros j. unfold edge. rewrite !INR_IZR_INZ. inn_auto. }
  exact (inn_between _ _ _ _ _ (E i) (E (S i)) H).
Qed.

(** The value at the point of [A, B] next to m. *)

Definition at_lowest (m A B vm vA vB : I.type) : I.type :=
  if is_neg (I.sub p m A) then vA
  else if is_neg (I.sub p B m) then vB
  else if is_pos (I.sub p m A) && is_pos (I.sub p B m) then vm else I.nai.

Lemma inn_nai : forall x, inn x I.nai.
Proof. intros x. unfold inn. rewrite I.nai_correct. exact I. Qed.

Lemma inn_at_lowest : forall (g : R -> R) m a b M A B vm vA vB, a <= b -> inn m M -> inn a A -> inn b B ->
  inn (g m) vm -> inn (g a) vA -> inn (g b) vB ->
  inn (g (Rmax a (Rmin m b))) (at_lowest M A B vm vA vB).
Proof.
  intros g m a b M A B vm vA vB Hab Hm Ha Hb Gm Ga Gb. unfold at_lowest.
  destruct (is_neg (I.sub p M A)) eqn:E1.
  { assert (Q := is_neg_ok _ _ (inn_sub p _ _ _ _ Hm Ha) E1). rewrite Rmin_left, Rmax_left by lra. exact Ga. }
  destruct (is_neg (I.sub p B M)) eqn:E2.
  { assert (Q := is_neg_ok _ _ (inn_sub p _ _ _ _ Hb Hm) E2). rewrite Rmin_right, Rmax_right by lra.
    exact Gb. }
  destruct (is_pos (I.sub p M A)) eqn:E3; [ | apply inn_nai].
  destruct (is_pos (I.sub p B M)) eqn:E4; [ | apply inn_nai]. simpl.
  assert (Q := is_pos_ok _ _ (inn_sub p _ _ _ _ Hm Ha) E3).
  assert (Q' := is_pos_ok _ _ (inn_sub p _ _ _ _ Hb Hm) E4).
  rewrite Rmin_left, Rmax_right by lra. exact Gm.
Qed.

(** The time a with cos a = f, and sin a. *)

Definition eval_sin_turn (f : I.type) : I.type := I.sqrt p (I.sub p (I.fromZ p 1) (I.mul p f f)).
Definition eval_turn (f : I.type) : I.type :=
  I.sub p (I.div p (I.pi p) (I.fromZ p 2)) (I.atan p (I.div p f (eval_sin_turn f))).

Lemma inn_turn : forall f Fi, 0 < f < 1 -> inn f Fi ->
  inn (turn f) (eval_turn Fi) /\ inn (sin (turn f)) (eval_sin_turn Fi).
Proof.
  intros f Fi Hf H. assert (E : inn (sqrt (1 - f * f)) (eval_sin_turn Fi)) by (unfold eval_sin_turn; inn_auto).
  split. unfold turn, eval_turn. inn_auto.
  destruct (turn_is f Hf) as (_ & -> & _). exact E.
Qed.

(** ** One cell *)

(** What does not depend on the cell. *)

Record window := { w_all : I.type; w_low : I.type; w_high : I.type; w_mid : I.type;
                   w_sin : I.type; w_cos_low : I.type; w_cos_high : I.type; w_cos_mid : I.type }.

Definition eval_window (w : range) : window :=
  let a := num p (fst w) in let b := num p (snd w) in
  let W := I.join a b in let m := I.div p (I.add p a b) (I.fromZ p 2) in
  {| w_all := W; w_low := a; w_high := b; w_mid := m;
     w_sin := I.sin p W; w_cos_low := I.cos p a; w_cos_high := I.cos p b; w_cos_mid := I.cos p m |}.

Record setting := { g_f : I.type; g_l : I.type; g_r : I.type; g_pi : I.type;
                    g_turn : I.type; g_sin_turn : I.type; g_1 : window; g_2 : window;
                    g_d0 : I.type; g_d1 : I.type; g_phi0 : I.type; g_phi1 : I.type }.

Definition eval_setting (f l r : I.type) (w1 w2 dd : range) (k : kind) : setting :=
  {| g_f := f; g_l := l; g_r := r; g_pi := I.pi p; g_turn := eval_turn f; g_sin_turn := eval_sin_turn f;
     g_1 := eval_window w1; g_2 := eval_window w2;
     g_d0 := num p (fst dd); g_d1 := num p (snd dd);
     g_phi0 := match k with Symmetric_minus => I.fromZ p 0 | _ => I.neg (I.div p (I.pi p) (I.fromZ p 2)) end;
     g_phi1 := match k with Symmetric_plus => I.fromZ p 0 | _ => I.div p (I.pi p) (I.fromZ p 2) end |}.

Section Cell.

Local Open Scope iv_scope.
Variable g : setting.
Notation f := (g_f g).
Notation l := (g_l g).
Notation r := (g_r g).
Notation pi := (g_pi g).
Notation w1 := (g_1 g).
Notation w2 := (g_2 g).

Definition windows_ok : bool :=
  is_pos (w_low w1) && is_pos (w_high w1 - w_low w1) && is_pos (w_low w2 - w_high w1) &&
  is_pos (w_high w2 - w_low w2) && is_pos (#2 * pi - w_high w2) &&
  is_pos (w_low w2 - pi / #2) && is_pos (pi - w_high w1).

Definition x1 (A B t cos_t : I.type) : I.type := A + B * t + #1 - cos_t - f * (t * t) / #2.
Definition slope1 (B : I.type) : I.type := B + w_sin w1 - f * w_all w1.
Definition first_in (A B : I.type) : I.type :=
  I.meet (w_all w1) (w_mid w1 + (r - x1 A B (w_mid w1) (w_cos_mid w1)) / slope1 B).

Definition x2 (y s cos_s t cos_t : I.type) : I.type :=
  r - y * (t - s) - cos_t + cos_s + f * (t * t - s * s) / #2.
Definition slope2 (y : I.type) : I.type := - (y - w_sin w2 - f * w_all w2).
Definition second_in (y s cos_s : I.type) : I.type :=
  I.meet (w_all w2) (w_mid w2 + (l - x2 y s cos_s (w_mid w2) (w_cos_mid w2)) / slope2 y).

Definition tests1 (A B s sin_s : I.type) : bool :=
  is_pos (A - l) && is_pos B && is_pos (r - x1 A B (w_low w1) (w_cos_low w1)) &&
  is_pos (x1 A B (w_high w1) (w_cos_high w1) - r) && is_pos (B + sin_s - f * s).

Definition tests2 (y s cos_s : I.type) : bool :=
  is_pos (x2 y s cos_s (w_low w2) (w_cos_low w2) - l) &&
  is_pos (l - x2 y s cos_s (w_high w2) (w_cos_high w2)).

Definition tests3 (u1 y s q sin_q cos_q : I.type) : bool :=
  let u2 := y - sin_q - f * q in
  let z := y - #2 * sin_q in
  let last := z - f * (#2 * pi) in
  let back := pi - g_turn g in
  let forth := #2 * pi - g_turn g in
  is_pos u2 &&
  is_pos (at_lowest back s q (y - g_sin_turn g - f * back) u1 u2) &&
  is_pos (at_lowest forth q (#2 * pi) (z - g_sin_turn g - f * forth) u2 last) && is_pos last &&
  is_pos (r - (l + z * (#2 * pi - q) - #1 + cos_q - f * (#4 * pi * pi - q * q) / #2)) &&
  is_nonneg ((q - s - pi) / #2 - g_d0 g) && is_nonneg (g_d1 g - (q - s - pi) / #2) &&
  is_pos ((s + q) / #2 - pi - g_phi0 g) && is_pos (g_phi1 g - ((s + q) / #2 - pi)).

Definition cell_ok (A B : I.type) : bool :=
  let s := first_in A B in
  let sin_s := I.sin p s in
  let cos_s := I.cos p s in
  let y := B + #2 * sin_s in
  let q := second_in y s cos_s in
  is_pos (slope1 B) && is_neg (slope2 y) && tests1 A B s sin_s && tests2 y s cos_s &&
  tests3 (B + sin_s - f * s) y s q (I.sin p q) (I.cos p q).

End Cell.

(** Between which numbers phi = - arcsin S must lie. *)

Definition phi_low (k : kind) : R := match k with Symmetric_minus => 0 | _ => (- (PI / 2))%R end.
Definition phi_high (k : kind) : R := match k with Symmetric_plus => 0 | _ => (PI / 2)%R end.

(** What the flights are in terms of the state and the times. *)

Lemma pos1_is : forall f a b t, pos f 1 0 a b t = a + b * t + 1 - cos t - f * (t * t) / 2.
Proof. intros. unfold pos. rewrite sin_0, cos_0. field. Qed.

Lemma after1_is : forall f b t, after1 f b t = b + sin t - f * t.
Proof. intros. unfold after1, vel. rewrite sin_0. ring. Qed.

Lemma back_is : forall f b s t, back_speed f s (after1 f b s) t = b + 2 * sin s - sin t - f * t.
Proof. intros. unfold back_speed. unfold vel. rewrite after1_is. ring. Qed.

Lemma pos2_is : forall f r b s t, pos f (-1) s r (- after1 f b s) t =
  r - (b + 2 * sin s) * (t - s) - cos t + cos s + f * (t * t - s * s) / 2.
Proof. intros. rewrite after1_is. unfold pos. field. Qed.

Lemma forth_is : forall f b s q t, forth_speed f q (after2 f b s q) t =
  b + 2 * sin s - 2 * sin q + sin t - f * t.
Proof. intros. unfold forth_speed, after2, vel. rewrite after1_is. ring. Qed.

Lemma end_x_is : forall f l b s q, end_x f l b s q =
  l + (b + 2 * sin s - 2 * sin q) * (2 * PI - q) - 1 + cos q - f * (4 * PI * PI - q * q) / 2.
Proof.
  intros. unfold end_x, after2, pos, vel. rewrite after1_is, cos_2PI. field.
Qed.

(** The root of a function with slope in an interval away from 0. *)

Lemma newton_in : forall (g g' : R -> R) m s y W M Gm Y Sl, (forall t, is_derive g t (g' t)) ->
  inn s W -> inn m W -> inn m M -> inn (g m) Gm -> inn y Y -> g s = y ->
  (forall t, inn t W -> inn (g' t) Sl) -> is_pos Sl = true \/ is_neg Sl = true ->
  inn s (I.meet W (I.add p M (I.div p (I.sub p Y Gm) Sl))).
Proof.
  intros g g' m s y W M Gm Y Sl Dg Hs Hm HM HG HY E HS Sign.
  destruct (MVT_between g g' m s Dg) as [c [Hc Q]].
  assert (Wc : inn c W).
  { unfold inn in *. destruct (Rle_dec m s) as [L | L].
    - rewrite Rmin_left, Rmax_right in Hc by lra. exact (contains_connected _ _ _ Hm Hs c Hc).
    - rewrite Rmin_right, Rmax_left in Hc by lra. exact (contains_connected _ _ _ Hs Hm c Hc). }
  assert (N : g' c <> 0).
  { destruct Sign as [Sg | Sg]. apply is_pos_ok with (1 := HS c Wc) in Sg. lra.
    apply is_neg_ok with (1 := HS c Wc) in Sg. lra. }
  unfold inn. apply I.meet_correct. exact Hs.
  change (inn s (I.add p M (I.div p (I.sub p Y Gm) Sl))).
  replace s with (m + (y - g m) / g' c). 2: { rewrite <- E, Q. field. exact N. }
  apply inn_add. exact HM. apply inn_div. apply inn_sub; assumption. apply HS, Wc.
Qed.

Theorem cell_known : forall f l r Fi L Ri w1 w2 dd k A B a b, 0 < f < 1 ->
  inn f Fi -> inn l L -> inn r Ri -> windows_ok (eval_setting Fi L Ri w1 w2 dd k) = true ->
  cell_ok (eval_setting Fi L Ri w1 w2 dd k) A B = true -> inn a A -> inn b B ->
  hits_known f l r a b (value (fst dd)) (value (snd dd)) (phi_low k) (phi_high k).
Proof.
  intros f l r Fi L Ri w1 w2 dd k A B a b f_small Hf Hl Hr HW HC Ha Hb.
  set (g := eval_setting Fi L Ri w1 w2 dd k) in *.
  set (a1 := value (fst w1)). set (b1 := value (snd w1)).
  set (a2 := value (fst w2)). set (b2 := value (snd w2)). set (m1 := (a1 + b1) / 2).
  set (m2 := (a2 + b2) / 2).
  assert (Gf : inn f (g_f g)) by exact Hf. assert (Gl : inn l (g_l g)) by exact Hl.
  assert (Gr : inn r (g_r g)) by exact Hr. assert (Gpi : inn PI (g_pi g)) by exact (inn_PI p).
  destruct (inn_turn f Fi f_small Hf) as [Ht Hst].
  assert (Gt : inn (turn f) (g_turn g)) by exact Ht.
  assert (Gs : inn (sin (turn f)) (g_sin_turn g)) by exact Hst.
  assert (A1 : inn a1 (w_low (g_1 g))) by exact (inn_num p (fst w1)).
  assert (B1 : inn b1 (w_high (g_1 g))) by exact (inn_num p (snd w1)).
  assert (A2 : inn a2 (w_low (g_2 g))) by exact (inn_num p (fst w2)).
  assert (B2 : inn b2 (w_high (g_2 g))) by exact (inn_num p (snd w2)).
  assert (M1 : inn m1 (w_mid (g_1 g))) by (unfold m1, a1, b1; simpl; auto using inn_num with inn).
  assert (M2 : inn m2 (w_mid (g_2 g))) by (unfold m2, a2, b2; simpl; auto using inn_num with inn).
  assert (CA1 : inn (cos a1) (w_cos_low (g_1 g))) by exact (inn_cos p _ _ A1).
  assert (CB1 : inn (cos b1) (w_cos_high (g_1 g))) by exact (inn_cos p _ _ B1).
  assert (CA2 : inn (cos a2) (w_cos_low (g_2 g))) by exact (inn_cos p _ _ A2).
  assert (CB2 : inn (cos b2) (w_cos_high (g_2 g))) by exact (inn_cos p _ _ B2).
  assert (CM1 : inn (cos m1) (w_cos_mid (g_1 g))) by exact (inn_cos p _ _ M1).
  assert (CM2 : inn (cos m2) (w_cos_mid (g_2 g))) by exact (inn_cos p _ _ M2).
  assert (InW1 : forall t, a1 <= t <= b1 -> inn t (w_all (g_1 g))).
  { intros t H. apply (inn_between a1 t b1); assumption. }
  assert (InW2 : forall t, a2 <= t <= b2 -> inn t (w_all (g_2 g))).
  { intros t H. apply (inn_between a2 t b2); assumption. }
  assert (SW1 : forall t, inn t (w_all (g_1 g)) -> inn (sin t) (w_sin (g_1 g))).
  { intros t H. exact (inn_sin p _ _ H). }
  assert (SW2 : forall t, inn t (w_all (g_2 g)) -> inn (sin t) (w_sin (g_2 g))).
  { intros t H. exact (inn_sin p _ _ H). }
  assert (D1 : inn (value (fst dd)) (g_d0 g)) by exact (inn_num p (fst dd)).
  assert (D2 : inn (value (snd dd)) (g_d1 g)) by exact (inn_num p (snd dd)).
  assert (Half : inn (PI / 2) (I.div p (I.pi p) (I.fromZ p 2))) by inn_auto.
  assert (P1 : inn (phi_low k) (g_phi0 g)).
  { destruct k; [exact (inn_neg _ _ Half) | exact (inn_neg _ _ Half) | exact (inn_Z p 0)]. }
  assert (P2 : inn (phi_high k) (g_phi1 g)).
  { destruct k; [exact Half | exact (inn_Z p 0) | exact Half]. }
  clearbody g.
  unfold windows_ok in HW. rewrite !andb_true_iff in HW.
  destruct HW as [[[[[[O1 O2] O3] O4] O5] O6] O7].
  is_positive O1 a1. is_positive O2 (b1 - a1). is_positive O3 (a2 - b1). is_positive O4 (b2 - a2).
  is_positive O5 (2 * PI - b2). is_positive O6 (a2 - PI / 2). is_positive O7 (PI - b1).
  unfold cell_ok in HC. rewrite !andb_true_iff in HC. destruct HC as [[[[Sl1 Sl2] Ts1] Ts2] Ts3].
  (* the first hit *)
  assert (X1 : forall t Tm Ct, inn t Tm -> inn (cos t) Ct -> inn (pos f 1 0 a b t) (x1 g A B Tm Ct)).
  { intros t Tm Ct H1 H2. rewrite pos1_is. unfold x1. inn_auto. }
  assert (V1 : forall t, inn t (w_all (g_1 g)) ->
    inn (vel f 1 0 b t) (slope1 g B)).
  { intros t H. replace (vel f 1 0 b t) with (b + sin t - f * t) by (unfold vel; rewrite sin_0; ring).
    unfold slope1. inn_auto. }
  assert (S_in : forall s, at1 f r a b a1 b1 s -> inn s (first_in g A B)).
  { intros s [Hs Es]. unfold first_in.
    apply (newton_in (pos f 1 0 a b) (vel f 1 0 b) m1 s r); auto.
    - intros t. apply pos_derive.
    - apply InW1. unfold m1. lra. }
  set (Si := first_in g A B) in *. clearbody Si.
  assert (Y_in : forall s, inn s Si -> inn (b + 2 * sin s) (I.add p B (I.mul p (I.fromZ p 2) (I.sin p Si)))).
  { intros s H. inn_auto. }
  set (Y := I.add p B (I.mul p (I.fromZ p 2) (I.sin p Si))) in *. clearbody Y.
  (* the second hit *)
  assert (X2 : forall s t Tm Ct, inn s Si -> inn t Tm -> inn (cos t) Ct ->
    inn (pos f (-1) s r (- after1 f b s) t) (x2 g Y Si (I.cos p Si) Tm Ct)).
  { intros s t Tm Ct H1 H2 H3. rewrite pos2_is. specialize (Y_in s H1). unfold x2. inn_auto. }
  assert (Q_in : forall s q, at2 f l r a b a1 b1 a2 b2 s q ->
    inn q (second_in g Y Si (I.cos p Si))).
  { intros s q (Hs & Hq & Eq). specialize (S_in s Hs). unfold second_in.
    apply (newton_in (pos f (-1) s r (- after1 f b s)) (vel f (-1) s (- after1 f b s)) m2 q l); auto.
    - intros t. apply pos_derive.
    - apply InW2. unfold m2. lra.
    - intros t H. assert (E := back_is f b s t). unfold back_speed in E.
      replace (vel f (-1) s (- after1 f b s) t) with (- (b + 2 * sin s - sin t - f * t)) by lra.
      specialize (Y_in s S_in). unfold slope2. inn_auto. }
  set (Qi := second_in g Y Si (I.cos p Si)) in *. clearbody Qi.
  (* the tests *)
  unfold tests1 in Ts1. rewrite !andb_true_iff in Ts1. destruct Ts1 as [[[[I1 I2] E1] L1] U1].
  is_positive I1 (a - l). is_positive I2 b. is_positive E1 (r - pos f 1 0 a b a1).
  is_positive L1 (pos f 1 0 a b b1 - r).
  unfold tests2 in Ts2. rewrite !andb_true_iff in Ts2. destruct Ts2 as [E2 L2].
  unfold tests3 in Ts3. rewrite !andb_true_iff in Ts3.
  destruct Ts3 as [[[[[[[[U2 Bk] Fo] Last] Stop] Dl] Dh] Pl] Ph].
  set (U1i := I.sub p (I.add p B (I.sin p Si)) (I.mul p (g_f g) Si)) in *.
  set (U2i := I.sub p (I.sub p Y (I.sin p Qi)) (I.mul p (g_f g) Qi)) in *.
  set (Zi := I.sub p Y (I.mul p (I.fromZ p 2) (I.sin p Qi))) in *.
  set (Li := I.sub p Zi (I.mul p (g_f g) (I.mul p (I.fromZ p 2) (g_pi g)))) in *.
  destruct (turn_is f f_small) as (_ & Est & Bt).
  assert (U1_in : forall s, inn s Si -> inn (after1 f b s) U1i).
  { intros s H. rewrite after1_is. unfold U1i. inn_auto. }
  assert (At : forall s q, at2 f l r a b a1 b1 a2 b2 s q -> s <= q <= 2 * PI /\ inn s Si /\ inn q Qi /\
    inn (after1 f b s) U1i /\ inn (after2 f b s q) U2i /\ inn (b + 2 * sin s - 2 * sin q) Zi /\
    inn (end_v f b s q) Li).
  { intros s q H. assert (Hs := S_in s (proj1 H)). assert (Hq := Q_in s q H).
    destruct H as ((? & _) & ? & _). specialize (Y_in s Hs). split. lra. split. exact Hs. split. exact Hq.
    split. apply U1_in, Hs. split.
    { assert (E := forth_is f b s q q). unfold forth_speed in E. rewrite vel_start in E. rewrite E.
      replace (b + 2 * sin s - 2 * sin q + sin q - f * q) with (b + 2 * sin s - sin q - f * q) by ring.
      unfold U2i. inn_auto. }
    assert (Hz : inn (b + 2 * sin s - 2 * sin q) Zi) by (unfold Zi; inn_auto).
    split. exact Hz. unfold end_v. assert (E := forth_is f b s q (2 * PI)). unfold forth_speed in E.
    rewrite E, sin_2PI.
    replace (b + 2 * sin s - 2 * sin q + 0 - f * (2 * PI)) with (b + 2 * sin s - 2 * sin q - f * (2 * PI))
      by ring.
    unfold Li. inn_auto. }
  destruct (cell_passes f l r a b a1 b1 a2 b2) as (s & q & P & Asq); auto.
  - lra.
  - lra.
  - lra.
  - lra.
  - intros s Hs. specialize (S_in s Hs).
    assert (Q := X2 s a2 _ _ S_in A2 CA2).
    apply is_pos_ok with (x := pos f (-1) s r (- after1 f b s) a2 - l) in E2; [lra | inn_auto].
  - intros s Hs. specialize (S_in s Hs).
    assert (Q := X2 s b2 _ _ S_in B2 CB2).
    apply is_pos_ok with (x := l - pos f (-1) s r (- after1 f b s) b2) in L2; [lra | inn_auto].
  - intros s Hs. split. exact I2. apply is_pos_ok with (1 := U1_in s (S_in s Hs)). exact U1.
  - intros s q H. destruct (At s q H) as (O & Hs & Hq & Hu1 & Hu2 & Hz & Hl').
    split. 2: { apply is_pos_ok with (1 := Hu2). exact U2. }
    apply is_pos_ok with (2 := Bk). unfold back_lowest.
    apply (inn_at_lowest (back_speed f s (after1 f b s))); auto.
    + lra.
    + inn_auto.
    + rewrite back_is, sin_minus, sin_PI, cos_PI. specialize (Y_in s Hs).
      match goal with |- inn ?x _ => replace x with (b + 2 * sin s - sin (turn f) - f * (PI - turn f)) by ring end.
      inn_auto.
    + rewrite back_is. replace (b + 2 * sin s - sin s - f * s) with (after1 f b s) by (rewrite after1_is; ring).
      exact Hu1.
  - intros s q H. destruct (At s q H) as (O & Hs & Hq & Hu1 & Hu2 & Hz & Hl').
    split. 2: { apply is_pos_ok with (1 := Hl'). exact Last. }
    apply is_pos_ok with (2 := Fo).
    replace (Rmax q (2 * PI - turn f)) with (Rmax q (Rmin (2 * PI - turn f) (2 * PI)))
      by (rewrite Rmin_left by lra; reflexivity).
    apply (inn_at_lowest (forth_speed f q (after2 f b s q))); auto.
    + lra.
    + inn_auto.
    + inn_auto.
    + rewrite forth_is, sin_minus, sin_2PI, cos_2PI.
      match goal with |- inn ?x _ =>
        replace x with (b + 2 * sin s - 2 * sin q - sin (turn f) - f * (2 * PI - turn f)) by ring end.
      inn_auto.
    + unfold forth_speed. rewrite vel_start. exact Hu2.
  - intros s q H. destruct (At s q H) as (O & Hs & Hq & Hu1 & Hu2 & Hz & Hl').
    rewrite end_x_is. 
    match type of Stop with is_pos (I.sub p _ ?X) = true =>
      assert (Hx : inn (l + (b + 2 * sin s - 2 * sin q) * (2 * PI - q) - 1 + cos q
        - f * (4 * PI * PI - q * q) / 2) X) by inn_auto end.
    is_positive Stop (r - (l + (b + 2 * sin s - 2 * sin q) * (2 * PI - q) - 1 + cos q
        - f * (4 * PI * PI - q * q) / 2)). lra.
  - destruct (At s q Asq) as (O & Hs & Hq & _).
    is_nonnegative Dl ((q - s - PI) / 2 - value (fst dd)).
    is_nonnegative Dh (value (snd dd) - (q - s - PI) / 2).
    is_positive Pl ((s + q) / 2 - PI - phi_low k). is_positive Ph (phi_high k - ((s + q) / 2 - PI)).
    exists s, q. split. exact P. split. lra. lra.
Qed.

End Evaluation.
