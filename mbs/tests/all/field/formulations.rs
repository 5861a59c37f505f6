//! What single formulations stopped at.
