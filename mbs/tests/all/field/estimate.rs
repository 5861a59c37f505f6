//! What a run says of its own accuracy.
