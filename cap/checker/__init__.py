"""The checker: certificate -> VERIFIED or REJECTED, in its own arithmetic and its own mechanics.

It uses Python's standard library alone and imports nothing else of cap.  A certificate contributes
numbers, never conditions: what must be shown follows from the parameters and the name of the
theorem.  Read the modules in this order; each begins with the mathematics that it implements.

    rejection    the one way to fail
    interval     intervals with ends in 2^-bits Z, rounded outwards
    elementary   pi, cosine, sine, arccosine of intervals
    jet          truncated Taylor series in two variables; the mean value form over a box
    mechanics    flights, hits, itineraries, the period map
    normal_form  Birkhoff's normal form and its twists
    certificate  the strict reading of a certificate
    citations    the theorems on paper that are used, with their hypotheses
    fixed_point  what both theorems share: Krawczyk, and the orbit
    theorem      the two theorems, step by step
    statement    the theorem that was proved, in words and in LaTeX
"""
