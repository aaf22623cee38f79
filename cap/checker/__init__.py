"""The checker: certificate -> VERIFIED or REJECTED, in its own arithmetic and its own mechanics.

It uses Python's standard library alone and imports nothing else of cap.  A certificate contributes
numbers, never conditions: what must be shown follows from the parameters and the name of the
theorem.  Only the theorem that a certificate names is loaded, with what it needs:

    python -m cap.verify --reading elliptic

lists these files in the order to read them.  Each begins with the mathematics that it implements.

    kernel      rejection, strict reading, shapes; intervals, elementary functions, jets; doubles
    system      a system as data: polynomials, modes, guards, resets; closed forms of its flights,
                exponentials; Lemma B (quiet legs); the lemma of chatter; a system that is given
                in the certificate, its periodic orbits by contacts; what theorems about
                one mass, or two, have in common: parameters and units
    flow        flights, hits, stops, capture, itineraries; launches
    maps        fixed points of the map over n periods, and Birkhoff's normal form
    release     maps from one release to the next, over intervals of places and of f
    folded      the flow folded by its symmetry, in doubles: places of release, first stops
    attracting  what attracts there, a file each: loaded only where a certificate claims it
    resting     cells of states at a wall, in doubles: which rest in time, and which fly
    strips      launches from wall to wall that go on in vain, level by level
    one_one     the orbits with one hit of each wall per period, in closed form; the paper's
                equation, loaded only where a certificate claims its roots
    coverings   parallelograms that cover each other under a planar map, of a half period, given by
                formulas, or from contact to contact; entropy without diamonds, also in time
    particles   two masses: flights, contacts, periodic orbits, the normal form
    tori        invariant curves: functions on the circle, half periods, the a-posteriori theorem;
                from outside: segments carried over half periods, polygons around a point
    theorems    one file each: statement, tables of claims and hints, citations, proof, words
    verdict     a certificate is checked
"""
