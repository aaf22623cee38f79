"""Float mode for any system: its flow in doubles, compiled from the model."""
