"""The checker: certificate -> VERIFIED or REJECTED, in its own arithmetic and its own mechanics.

It uses Python's standard library alone and imports nothing else of cap.  A certificate contributes
numbers, never conditions: what must be shown follows from the parameters and the name of the
theorem.  Read the modules in this order; each begins with the mathematics that it implements.

    rejection    the one way to fail
    interval     intervals with ends in 2^-bits Z, rounded outwards
    elementary   pi, cosine, sine, arccosine, exponential of intervals
    jet          truncated Taylor series in several variables; the mean value form over a box
    mechanics    flights, and the sign of the velocity on them
    events       hits, turns, sticks, releases
    capture      infinitely many hits in finite time
    itinerary    the events in their order; the map over n periods
    normal_form  Birkhoff's normal form and its twists
    taylor_model a polynomial and a bound of the error, on a whole interval
    series       quotient, square root, cosine and sine of jets over intervals or Taylor models
    impact       the orbits with one hit of each wall per period, in closed form
    twist        the first twist along a family of such orbits
    reading      the strict reading of JSON
    forms        the form of a certificate on such orbits
    certificate  the form of a certificate
    citations    the theorems on paper that are used, with their hypotheses
    fixed_point  what the theorems about a fixed point share: Krawczyk, and the comparisons
    periodic     the theorem about periodic orbits: type, multipliers, basin
    persistence  the theorem about a range of losses
    captured     the theorem about capture
    symmetric    the theorem about the symmetric orbits with one hit of each wall
    pitchfork    the theorem about the birth of a pair of such orbits that are not symmetric
    branch       the theorem about these pairs for a range of f
    theorem      the theorems by name; the elliptic point and the saddle
    terms        what stands in more than one sentence
    sentences    the last three theorems in words
    statement    the theorem that was proved, in words and in LaTeX
"""
