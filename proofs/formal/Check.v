(** * The checker: a list of tests on the numbers of a certificate, computed in intervals

    If all of them succeed the theorem holds with these numbers ([elliptic_checked], [saddle_checked]
    in Checked.v).  Here is nothing but the computation. *)

From Coq Require Import Reals ZArith Bool List.
From Cap Require Import Statement Jet Stages Enclosure Data EvalOrbit EvalBox Moeckel.
Import ListNotations.

(** The tests have names, for a person whose certificate fails. *)

Inductive test :=
  parameters | the_bracket_of_d | the_order_of_hits | least_speed_claim | hit_1_claim | hit_2_claim
| speed_1_claim | speed_2_claim | forcing_1_claim | forcing_2_claim | box_claim | taylor_x_claim
| taylor_v_claim | trace_claim | trace_in_minus_2_2 | no_resonance | the_entry_c | angle_claim
| rotation_claim | twist_claim | twist_not_0 | state_claim | derivative_claim
| trace_outside_minus_2_2 | outer_claim | inner_claim | windows_of_hits | one_orbit_in_the_box
| cells_of_the_box.

Section Check.

Variables (n_ : orbit_data) (h : hints).

Section Units.

Variable p : F.precision.

Definition lam : I.type := I.div p (num p (F_ n_)) (I.mul p (num p (w_ n_)) (num p (w_ n_))).
Definition unit_U : I.type := I.mul p lam (num p (w_ n_)).
Definition scaled_f : I.type := I.div p (num p (f_ n_)) (num p (F_ n_)).
Definition scaled_l : I.type := I.div p (num p (l_ n_)) lam.
Definition scaled_r : I.type := I.div p (num p (r_ n_)) lam.
Definition scaled_rho : I.type := I.sub p scaled_r scaled_l.

(** k X lies within the range. *)

Definition inside (k : I.type) (c : range) (X : I.type) : bool :=
  let y := I.mul p k X in is_nonneg (I.sub p y (num p (fst c))) && is_nonneg (I.sub p (num p (snd c)) y).

Definition inside_jet (k a b : I.type) (c : jet range) (J : jet I.type) : bool :=
  let m := I.mul p in
  inside k (c00 c) (c00 J) && inside (m k a) (c10 c) (c10 J) && inside (m k b) (c01 c) (c01 J) &&
  inside (m k (m a a)) (c20 c) (c20 J) && inside (m k (m a b)) (c11 c) (c11 J) &&
  inside (m k (m b b)) (c02 c) (c02 J) &&
  inside (m k (m (m a a) a)) (c30 c) (c30 J) && inside (m k (m (m a a) b)) (c21 c) (c21 J) &&
  inside (m k (m (m a b) b)) (c12 c) (c12 J) && inside (m k (m (m b b) b)) (c03 c) (c03 J).

End Units.

(** ** The orbit, its map, and what is claimed of them *)

Section Orbit.

Let p : F.precision := F.PtoP (bits h).
Notation "x + y" := (I.add p x y).
Notation "x - y" := (I.sub p x y).
Notation "x * y" := (I.mul p x y).
Notation "x / y" := (I.div p x y).
Notation "# z" := (I.fromZ p z) (at level 5).

Definition bracket : I.type := I.join (num p (fst (d_ h))) (num p (snd (d_ h))).

Definition asymmetric_ok : bool :=
  let f := scaled_f p in let rho := scaled_rho p in let D := bracket in
  let d0 := num p (fst (d_ h)) in let d1 := num p (snd (d_ h)) in
  let k0 := eval_friction p rho d0 - f in let k1 := eval_friction p rho d1 - f in
  is_pos (d1 - d0) && (is_pos D || is_neg D) && is_pos (eval_G p D - rho) &&
  ((is_neg k0 && is_pos k1) || (is_pos k0 && is_neg k1)).

Definition bracket_ok : bool :=
  match kind_ h with
  | Asymmetric => asymmetric_ok
  | _ => is_pos (#1 - eval_C_sym p (scaled_f p))
  end.

Definition the_shape : shape :=
  match kind_ h with
  | Asymmetric => eval_asymmetric p (scaled_rho p) bracket (eval_G p bracket)
  | Symmetric_plus => eval_symmetric p (scaled_rho p) (scaled_f p) 1
  | Symmetric_minus => eval_symmetric p (scaled_rho p) (scaled_f p) (-1)
  end.

Definition speeds_of (f u1 u2 : I.type) (s : around I.type) : list I.type :=
  let pi := I.pi p in let a := eval_turn p f in let q := eval_sin_turn p f in
  let back := pi - a in let forth := #2 * pi - a in
  [ u1; u2;
    at_lowest p back (e_t1 s) (e_t2 s) (u1 - q + e_sin1 s - f * (back - e_t1 s)) u1 u2;
    at_lowest p forth (e_t2 s) (e_t1 s + #2 * pi) (u2 - q - e_sin2 s - f * (forth - e_t2 s)) u2 u1 ].

Definition orbit_tests (o : shape) (s : around I.type) : list (test * bool) :=
  let pi := I.pi p in
  let F := num p (F_ n_) in let w := num p (w_ n_) in
  let L := lam p in let U := unit_U p in
  let f := scaled_f p in
  let u1 := eval_u1 p f o in let u2 := eval_u2 p f o in
  let speeds := speeds_of f u1 u2 s in
  [ (parameters, is_pos F && is_pos w && is_pos f && is_pos (#1 - f) && is_pos (scaled_rho p));
    (the_bracket_of_d, bracket_ok);
    (the_order_of_hits, is_pos (e_t1 s) && is_pos (e_t2 s - e_t1 s) && is_pos (e_t2 s - pi / #2) &&
       is_pos (#2 * pi - e_t2 s) && is_pos (e_t1 s + #2 * pi - e_t2 s) && is_pos (pi - e_t1 s));
    (least_speed_claim, is_pos (num p (fst (least_speed_ n_))) &&
       forallb (fun u => is_nonneg (U * u - num p (fst (least_speed_ n_)))) speeds &&
       existsb (fun u => is_nonneg (num p (snd (least_speed_ n_)) - U * u)) speeds);
    (hit_1_claim, inside p (I.inv p w) (hit_1_ n_) (e_t1 s));
    (hit_2_claim, inside p (I.inv p w) (hit_2_ n_) (e_t2 s));
    (speed_1_claim, inside p U (speed_1_ n_) u1);
    (speed_2_claim, inside p U (speed_2_ n_) u2);
    (forcing_1_claim, inside p (U * w) (forcing_1_ n_) (I.abs (e_cos1 s) - f));
    (forcing_2_claim, inside p (U * w) (forcing_2_ n_) (I.abs (e_cos2 s) - f));
    (box_claim, inside p L (box_x_ n_) (e_x s) && inside p U (box_v_ n_) (e_v s)) ].

Definition trace_tests (J : jet I.type * jet I.type) : list (test * bool) :=
  [ (trace_claim, inside p #1 (trace_ n_) (c10 (fst J) + c01 (snd J))) ].

End Orbit.

(** ** The box, in fewer bits *)

Section Box.

Let p : F.precision := F.PtoP (box_bits h).

Definition monotone_ok (rho D : I.type) : bool :=
  (is_pos D || is_neg D) && is_pos (I.sub p (eval_G p D) rho) &&
  (if is_pos D then is_neg (eval_friction' p rho D) else is_pos (eval_friction' p rho D)).

(** No other orbit has its d in D. *)

Definition alone_ok (f rho D : I.type) : bool :=
  match kind_ h with
  | Asymmetric => monotone_ok rho D
  | Symmetric_plus => eval_impossible p rho D f true
  | Symmetric_minus => eval_impossible p rho D f false
  end.

(** The cell i, j of n x n cells, or else its four quarters, and so on. *)

Fixpoint cover (depth : nat) (g : setting) (L U : I.type) (n i j : nat) : bool :=
  if cell_ok p g (I.div p (part p (box_x_ n_) n i) L) (I.div p (part p (box_v_ n_) n j) U) then true
  else match depth with
    | 0%nat => false
    | S d => let i2 := (2 * i)%nat in let j2 := (2 * j)%nat in let c := cover d g L U (2 * n)%nat in
        if c i2 j2 then if c i2 (S j2) then if c (S i2) j2 then c (S i2) (S j2) else false else false
        else false
    end.

Definition box_tests : list (test * bool) :=
  let f := scaled_f p in let l := scaled_l p in let r := scaled_r p in
  let g := eval_setting p f l r (window_1 h) (window_2 h) (d_box h) (kind_ h) in
  [ (windows_of_hits, windows_ok p g);
    (one_orbit_in_the_box,
      let k := Pos.to_nat (pieces h) in
      all_below k (fun i => alone_ok f (scaled_rho p) (part p (d_box h) k i)));
    (cells_of_the_box, cover (depth h) g (lam p) (unit_U p) 1 0 0) ].

End Box.

(** All tests; [more] is about the type of the orbit. *)

Definition tests_with (more : around I.type -> jet I.type * jet I.type -> list (test * bool)) :
  list (test * bool) :=
  let p := F.PtoP (bits h) in
  let o := the_shape in
  let s := eval_state p (scaled_f p) (scaled_l p) (scaled_r p) o in
  let J := jmap (iv p) s in
  orbit_tests o s ++ trace_tests J ++ more s J ++ box_tests.

End Check.

Definition passed (tests : list (test * bool)) : bool := forallb snd tests.

(** The names of the tests that fail. *)

Definition failures (tests : list (test * bool)) : list test :=
  map fst (filter (fun t => negb (snd t)) tests).

(** ** The type of the orbit *)

Section Type_of_orbit.

Variable h : hints.
Let p : F.precision := F.PtoP (bits h).
Notation "x + y" := (I.add p x y).
Notation "x - y" := (I.sub p x y).
Notation "x * y" := (I.mul p x y).
Notation "x / y" := (I.div p x y).
Notation "# z" := (I.fromZ p z) (at level 5).

Definition elliptic_type (n_ : elliptic_data) (J : jet I.type * jet I.type) : list (test * bool) :=
  let pi := I.pi p in
  let L := lam n_ p in let U := unit_U n_ p in let L' := I.inv p L in let U' := I.inv p U in
  let jx := fst J in let jv := snd J in
  let tr := c10 jx + c01 jv in let cs := tr / #2 in
  let root := I.sqrt p (#1 - cs * cs) in
  let up := is_pos (c10 jv) in let sign := #(if up then 1 else -1) in
  let theta := pi / #2 - I.atan p (cs / root) in
  let sn := sign * root in
  let tau := moeckel (iv p) jx jv cs sn ((cs - c10 jx) / c10 jv) (sn / c10 jv) in
  [ (taylor_x_claim, inside_jet p L L' U' (taylor_x_ n_) jx);
    (taylor_v_claim, inside_jet p U L' U' (taylor_v_ n_) jv);
    (trace_in_minus_2_2, is_pos (#1 - cs) && is_pos (cs + #1));
    (no_resonance, (is_pos (#2 * cs + #1) || is_neg (#2 * cs + #1)) && (is_pos cs || is_neg cs));
    (the_entry_c, up || is_neg (c10 jv));
    (angle_claim, inside p #1 (angle_ n_) (sign * theta));
    (rotation_claim, inside p #1 (rotation_ n_) (theta / (#2 * pi)));
    (twist_claim, inside p (I.inv p (L * U)) (twist_ n_) tau);
    (twist_not_0, is_pos tau || is_neg tau) ].

Definition saddle_type (n_ : saddle_data) (x v : I.type) (J : jet I.type * jet I.type) :
  list (test * bool) :=
  let L := lam n_ p in let U := unit_U n_ p in let w := num p (w_ n_) in
  let jx := fst J in let jv := snd J in
  let tr := c10 jx + c01 jv in
  let up := is_pos tr in let sign := #(if up then 1 else -1) in
  let root := I.sqrt p (tr * tr - #4) in
  [ (state_claim, inside p L (state_x_ n_) x && inside p U (state_v_ n_) v);
    (derivative_claim, inside p #1 (x_x_ n_) (c10 jx) && inside p (I.inv p w) (x_v_ n_) (c01 jx) &&
       inside p w (v_x_ n_) (c10 jv) && inside p #1 (v_v_ n_) (c01 jv));
    (trace_outside_minus_2_2, is_pos (sign * tr - #2));
    (outer_claim, inside p #1 (outer_ n_) ((tr + sign * root) / #2));
    (inner_claim, inside p #1 (inner_ n_) ((tr + I.neg sign * root) / #2)) ].

End Type_of_orbit.

Definition elliptic_tests (n : elliptic_data) (h : hints) : list (test * bool) :=
  tests_with n h (fun _ => elliptic_type h n).

Definition saddle_tests (n : saddle_data) (h : hints) : list (test * bool) :=
  tests_with n h (fun s => saddle_type h n (e_x s) (e_v s)).
