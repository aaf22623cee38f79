(** * The numbers of a certificate

    Exact: integers, fractions, decimals.  [value] is the real number, in the form in which Coq reads
    and prints it (2 / 5, 0.25); [elliptic_claims_of] and [saddle_claims_of] are what the theorems say
    with these numbers.  The hints (brackets, cells, precision) do not occur in the theorems. *)

From Coq Require Import Reals ZArith List.
From Cap Require Import Statement Jet Enclosure.
Import ListNotations.
Open Scope R_scope.

Inductive number := Whole (n : Z) | Fraction (n : Z) (d : positive) | Decimal (n : Z) (places : positive).

Definition value (x : number) : R :=
  match x with
  | Whole n => IZR n
  | Fraction n d => IZR n / IZR (Z.pos d)
  | Decimal n places => IZR n / IZR (Z.pow_pos 10 places)
  end.

Definition num (p : F.precision) (x : number) : I.type :=
  match x with
  | Whole n => I.fromZ p n
  | Fraction n d => I.div p (I.fromZ p n) (I.fromZ p (Z.pos d))
  | Decimal n places => I.div p (I.fromZ p n) (I.fromZ p (Z.pow_pos 10 places))
  end.

Lemma inn_num : forall p x, inn (value x) (num p x).
Proof. intros p [n | n d | n k]; [apply inn_Z | apply inn_div; apply inn_Z | apply inn_div; apply inn_Z]. Qed.

Definition range := (number * number)%type.

Definition interval_of (x : range) : interval := {| lo := value (fst x); hi := value (snd x) |}.

Record orbit_data := {
  F_ : number; w_ : number; f_ : number; l_ : number; r_ : number;
  box_x_ : range; box_v_ : range; least_speed_ : range;
  hit_1_ : range; hit_2_ : range; speed_1_ : range; speed_2_ : range;
  forcing_1_ : range; forcing_2_ : range; trace_ : range }.

Record elliptic_data := {
  of_orbit_ :> orbit_data; taylor_x_ : jet range; taylor_v_ : jet range;
  angle_ : range; rotation_ : range; twist_ : range }.

Record saddle_data := {
  of_saddle_ :> orbit_data; state_x_ : range; state_v_ : range;
  x_x_ : range; x_v_ : range; v_x_ : range; v_v_ : range; outer_ : range; inner_ : range }.

(** Hints: the orbit is asymmetric, and its parameter d lies between two numbers, or it is symmetric
    with S > 0 or S < 0; the hits of all states of the box lie in two windows, and their parameter d
    between two numbers; this range of d is cut into so many pieces, and the box into quarters as
    often as [depth]; bits of the intervals. *)

Inductive kind := Asymmetric | Symmetric_plus | Symmetric_minus.

Record hints := {
  kind_ : kind; d_ : range; window_1 : range; window_2 : range; d_box : range;
  pieces : positive; depth : nat; bits : positive; box_bits : positive }.

Definition jet_map {K L} (g : K -> L) (j : jet K) : jet L :=
  Jet (g (c00 j)) (g (c10 j)) (g (c01 j)) (g (c20 j)) (g (c11 j)) (g (c02 j))
      (g (c30 j)) (g (c21 j)) (g (c12 j)) (g (c03 j)).

Definition orbit_claims_of (n : orbit_data) : orbit_claims := {|
  box_x := interval_of (box_x_ n); box_v := interval_of (box_v_ n);
  least_speed := interval_of (least_speed_ n);
  hit_1 := interval_of (hit_1_ n); hit_2 := interval_of (hit_2_ n);
  speed_1 := interval_of (speed_1_ n); speed_2 := interval_of (speed_2_ n);
  forcing_1 := interval_of (forcing_1_ n); forcing_2 := interval_of (forcing_2_ n);
  trace := interval_of (trace_ n) |}.

Definition elliptic_claims_of (n : elliptic_data) : elliptic_claims := {|
  of_orbit := orbit_claims_of n;
  taylor_x := jet_map interval_of (taylor_x_ n); taylor_v := jet_map interval_of (taylor_v_ n);
  angle := interval_of (angle_ n); rotation := interval_of (rotation_ n); twist := interval_of (twist_ n) |}.

Definition saddle_claims_of (n : saddle_data) : saddle_claims := {|
  of_saddle := orbit_claims_of n;
  state_x := interval_of (state_x_ n); state_v := interval_of (state_v_ n);
  x_x := interval_of (x_x_ n); x_v := interval_of (x_v_ n);
  v_x := interval_of (v_x_ n); v_v := interval_of (v_v_ n);
  outer := interval_of (outer_ n); inner := interval_of (inner_ n) |}.
