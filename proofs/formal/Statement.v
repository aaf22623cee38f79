(** * What is proved: every definition that the theorems need, and no proof

    A mass slides with dry friction between two walls and is forced periodically:

      x'' = F cos (w t) - f sgn x',   l < x < r,   v becomes - e v at the walls. *)

From Coq Require Import Reals.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

Section System.

Variables F w f l r e : R.

(** ** Motions

    At rest (v = 0) nothing is asked of the acceleration, so that every law of dry friction is
    included, sticking as well.  At a wall the velocity has a limit from the left, u towards the
    wall (u = 0 is allowed: contact), and is - e u then and in the limit from the right. *)

Definition free_law (x v : R -> R) (t : R) : Prop :=
  is_derive x t (v t) /\ continuous v t /\
  (v t <> 0 -> is_derive v t (F * cos (w * t) - f * sign (v t))).

Definition right_law (x v : R -> R) (t : R) : Prop :=
  continuous x t /\
  exists u, 0 <= u /\ filterlim v (at_left t) (locally u) /\
            v t = - e * u /\ filterlim v (at_right t) (locally (v t)).

Definition left_law (x v : R -> R) (t : R) : Prop :=
  continuous x t /\
  exists u, u <= 0 /\ filterlim v (at_left t) (locally u) /\
            v t = - e * u /\ filterlim v (at_right t) (locally (v t)).

Definition laws (x v : R -> R) (t : R) : Prop :=
  l <= x t <= r /\
  (l < x t < r -> free_law x v t) /\
  (x t = r -> right_law x v t) /\
  (x t = l -> left_law x v t).

(** A motion on [[a, b]], off the walls at its two ends. *)

Record motion (a b : R) (x v : R -> R) : Prop := {
  m_laws : forall t, a < t < b -> laws x v t;
  m_start : l < x a < r;
  m_stop : l < x b < r;
  m_start_x : filterlim x (at_right a) (locally (x a));
  m_start_v : filterlim v (at_right a) (locally (v a));
  m_stop_x : filterlim x (at_left b) (locally (x b));
  m_stop_v : filterlim v (at_left b) (locally (v b)) }.

Definition never_stops (a b : R) (v : R -> R) : Prop := forall t, a <= t <= b -> v t <> 0.

(** The map of the period T: the state (a, b) at time 0 becomes (y, z) by a motion that never
    stops, and by no motion anything else. *)

Definition T : R := 2 * PI / w.

Definition image (a b y z : R) : Prop :=
  (exists x v, motion 0 T x v /\ never_stops 0 T v /\ x 0 = a /\ v 0 = b /\ x T = y /\ v T = z) /\
  (forall x v, motion 0 T x v -> x 0 = a -> v 0 = b -> x T = y /\ v T = z).

End System.

(** ** Maps (X, V) of the plane around a point (x, v) *)

(** [f] is n times continuously differentiable around (x, v). *)

Fixpoint cont_diff (n : nat) (f : R -> R -> R) (x v : R) : Prop :=
  match n with
  | O => locally_2d (continuity_2d_pt f) x v
  | S n => exists p q,
      locally_2d (fun a b => differentiable_pt_lim f a b (p a b) (q a b)) x v /\
      cont_diff n p x v /\ cont_diff n q x v
  end.

(** [f] is infinitely often differentiable on a neighbourhood of (x, v), the same for all orders. *)

Definition smooth (f : R -> R -> R) (x v : R) : Prop :=
  locally_2d (fun a b => forall n, cont_diff n f a b) x v.

Definition preserves_area (X V : R -> R -> R) (x v : R) : Prop :=
  locally_2d (fun a b => exists A B C D, differentiable_pt_lim X a b A B /\
    differentiable_pt_lim V a b C D /\ A * D - B * C = 1) x v.

(** [f] is O(|(a, b)|^n) at 0. *)

Definition size (a b : R) : R := Rmax (Rabs a) (Rabs b).

Definition order (n : nat) (f : R -> R -> R) : Prop :=
  exists K d, 0 <= K /\ 0 < d /\ d <= 1 /\
    forall a b, size a b < d -> Rabs (f a b) <= K * size a b ^ n.

(** A polynomial of degree three: [cij] is the coefficient of a^i b^j. *)

Record jet (K : Type) := Jet { c00 : K; c10 : K; c01 : K; c20 : K; c11 : K; c02 : K;
                               c30 : K; c21 : K; c12 : K; c03 : K }.
Arguments Jet {K}. Arguments c00 {K}. Arguments c10 {K}. Arguments c01 {K}. Arguments c20 {K}.
Arguments c11 {K}. Arguments c02 {K}. Arguments c30 {K}. Arguments c21 {K}. Arguments c12 {K}.
Arguments c03 {K}.

Definition ev (j : jet R) (a b : R) : R :=
  c00 j + (c10 j * a + c01 j * b) + (c20 j * (a * a) + c11 j * (a * b) + c02 j * (b * b)) +
  (c30 j * (a * a * a) + c21 j * (a * a * b) + c12 j * (a * b * b) + c03 j * (b * b * b)).

(** [j] is the Taylor polynomial of degree three of [f] at (x, v). *)

Definition expands (f : R -> R -> R) (x v : R) (j : jet R) : Prop :=
  order 4 (fun a b => f (x + a) (v + b) - ev j a b).

(** Birkhoff's normal form: in coordinates z = A + i B given by polynomials x + h(A, B),
    v + k(A, B) with dx dv = dA dB at 0, the map is z exp(i (Theta + tau |z|^2)) + O(|z|^4). *)

Definition normal_form (X V : R -> R -> R) (x v Theta tau : R) : Prop :=
  exists h k : jet R, c00 h = 0 /\ c00 k = 0 /\ c10 h * c01 k - c01 h * c10 k = 1 /\
    let angle a b := Theta + tau * (a * a + b * b) in
    let A a b := cos (angle a b) * a - sin (angle a b) * b in
    let B a b := sin (angle a b) * a + cos (angle a b) * b in
    order 4 (fun a b => X (x + ev h a b) (v + ev k a b) - (x + ev h (A a b) (B a b))) /\
    order 4 (fun a b => V (x + ev h a b) (v + ev k a b) - (v + ev k (A a b) (B a b))).

(** No resonance exp(i k Theta) = 1 of order k at most four. *)

Definition nonresonant (Theta : R) : Prop :=
  forall k n : Z, (1 <= k <= 4)%Z -> IZR k * Theta <> IZR n * (2 * PI).

(** Stability of a point, and arbitrarily small closed curves around it (star-shaped in linear
    coordinates) that are mapped onto themselves, by steps from (a, b) to (y, z). *)

Definition stable (step : R -> R -> R -> R -> Prop) (x v : R) : Prop :=
  forall eps, 0 < eps -> exists d, 0 < d /\ forall a b, size (a - x) (b - v) < d ->
    exists p q : nat -> R, p 0%nat = a /\ q 0%nat = b /\
      forall n, step (p n) (q n) (p (S n)) (q (S n)) /\ size (p n - x) (q n - v) < eps.

Definition invariant_curves (step : R -> R -> R -> R -> Prop) (x v : R) : Prop :=
  forall eps, 0 < eps -> exists m n p q (rho : R -> R),
    let A s := x + rho s * (m * cos s + n * sin s) in
    let B s := v + rho s * (p * cos s + q * sin s) in
    m * q - n * p <> 0 /\
    (forall s, continuous rho s /\ 0 < rho s /\ rho (s + 2 * PI) = rho s) /\
    (forall s, size (A s - x) (B s - v) < eps) /\
    (forall s, exists s', step (A s) (B s) (A s') (B s')) /\
    (forall s', exists s, step (A s) (B s) (A s') (B s')).

(** Moser's twist theorem at a fixed point (1962; Siegel and Moser, Lectures on Celestial
    Mechanics, sections 32 to 34).  It is not proved here: it is a hypothesis of what follows it. *)

Definition Moser_twist_theorem : Prop := forall X V x v Theta tau,
  X x v = x -> V x v = v -> smooth X x v -> smooth V x v -> preserves_area X V x v ->
  normal_form X V x v Theta tau -> nonresonant Theta -> tau <> 0 ->
  let step a b y z := y = X a b /\ z = V a b in
  stable step x v /\ invariant_curves step x v.

(** ** The theorems: orbits with one hit of each wall per period, elliptic ones and saddles *)

Record interval := { lo : R; hi : R }.

Definition within (i : interval) (y : R) : Prop := lo i <= y <= hi i.

Record orbit_claims := { box_x : interval; box_v : interval; least_speed : interval;
  hit_1 : interval; hit_2 : interval; speed_1 : interval; speed_2 : interval;
  forcing_1 : interval; forcing_2 : interval; trace : interval }.

(** There is such an orbit, with these numbers; of the map (X, V) around it, its fixed point (x, v)
    and the Taylor polynomials there, [more] holds. *)

Definition orbit_with (F w f l r : R) (c : orbit_claims)
    (more : (R -> R -> R) -> (R -> R -> R) -> R -> R -> jet R -> jet R -> Prop) : Prop :=
  let T := T w in let image := image F w f l r 1 in
  exists (x v : R -> R) (t1 t2 : R),

  (* a motion with elastic walls, of period T, and its least speed *)
  (forall t, laws F w f l r 1 x v t) /\ (forall t, x (t + T) = x t /\ v (t + T) = v t) /\
  (forall t, lo (least_speed c) <= Rabs (v t)) /\ (exists t, Rabs (v t) <= hi (least_speed c)) /\

  (* it hits each wall once in a period *)
  (forall t, (x t = r <-> exists n, t = t1 + IZR n * T) /\
             (x t = l <-> exists n, t = t2 + IZR n * T)) /\
  within (hit_1 c) t1 /\ within (hit_2 c) t2 /\
  within (speed_1 c) (- v t1) /\ within (speed_2 c) (v t2) /\
  within (forcing_1 c) (Rabs (F * cos (w * t1)) - f) /\
  within (forcing_2 c) (Rabs (F * cos (w * t2)) - f) /\

  (* the map of the period exists on a box, and its orbit is the only one there of period T *)
  (forall a b, within (box_x c) a -> within (box_v c) b ->
     (exists y z, image a b y z) /\ (image a b a b -> a = x 0 /\ b = v 0)) /\
  within (box_x c) (x 0) /\ within (box_v c) (v 0) /\

  (* around it the map is (X, V): smooth and area-preserving *)
  exists (X V : R -> R -> R) (jx jv : jet R),
  locally_2d (fun a b => image a b (X a b) (V a b)) (x 0) (v 0) /\
  X (x 0) (v 0) = x 0 /\ V (x 0) (v 0) = v 0 /\
  smooth X (x 0) (v 0) /\ smooth V (x 0) (v 0) /\ preserves_area X V (x 0) (v 0) /\
  expands X (x 0) (v 0) jx /\ expands V (x 0) (v 0) jv /\
  c10 jx * c01 jv - c01 jx * c10 jv = 1 /\ within (trace c) (c10 jx + c01 jv) /\
  more X V (x 0) (v 0) jx jv.

(** An elliptic orbit, with its normal form. *)

Definition within_jet (i : jet interval) (j : jet R) : Prop :=
  within (c00 i) (c00 j) /\ within (c10 i) (c10 j) /\ within (c01 i) (c01 j) /\
  within (c20 i) (c20 j) /\ within (c11 i) (c11 j) /\ within (c02 i) (c02 j) /\
  within (c30 i) (c30 j) /\ within (c21 i) (c21 j) /\ within (c12 i) (c12 j) /\
  within (c03 i) (c03 j).

Record elliptic_claims := { of_orbit :> orbit_claims; taylor_x : jet interval; taylor_v : jet interval;
  angle : interval; rotation : interval; twist : interval }.

Definition elliptic (F w f l r : R) (c : elliptic_claims) (X V : R -> R -> R) (x v : R) (jx jv : jet R) : Prop :=
  within_jet (taylor_x c) jx /\ within_jet (taylor_v c) jv /\
  exists Theta tau, c10 jx + c01 jv = 2 * cos Theta /\ 0 < Rabs Theta < PI /\
  within (angle c) Theta /\ within (rotation c) (Rabs Theta / (2 * PI)) /\ nonresonant Theta /\
  normal_form X V x v Theta tau /\ within (twist c) tau /\ tau <> 0 /\
  (forall tau', normal_form X V x v Theta tau' -> tau' = tau) /\

  (* so it is stable if Moser's theorem holds *)
  (Moser_twist_theorem -> let image := image F w f l r 1 in
     stable image x v /\ invariant_curves image x v).

Definition elliptic_orbit (F w f l r : R) (c : elliptic_claims) : Prop :=
  orbit_with F w f l r c (elliptic F w f l r c).

(** A saddle: the derivative has real eigenvalues m and 1/m, |m| > 1. *)

Record saddle_claims := { of_saddle :> orbit_claims; state_x : interval; state_v : interval;
  x_x : interval; x_v : interval; v_x : interval; v_v : interval;
  outer : interval; inner : interval }.

Definition saddle (c : saddle_claims) (X V : R -> R -> R) (x v : R) (jx jv : jet R) : Prop :=
  within (state_x c) x /\ within (state_v c) v /\
  within (x_x c) (c10 jx) /\ within (x_v c) (c01 jx) /\
  within (v_x c) (c10 jv) /\ within (v_v c) (c01 jv) /\
  exists m, c10 jx + c01 jv = m + / m /\ 1 < Rabs m /\ within (outer c) m /\ within (inner c) (/ m).

Definition saddle_orbit (F w f l r : R) (c : saddle_claims) : Prop :=
  orbit_with F w f l r c (saddle c).
