"""Pictures of the figures of a paper: what `cap.paper` computes, beside what the paper says."""
