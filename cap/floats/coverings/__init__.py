"""Float search for parallelograms that cover each other: hints, nothing here is trusted."""
