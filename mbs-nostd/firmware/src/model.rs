//! The model: what `mbs export SCENE --rust FILE` wrote, FILE being named by MBS_MODEL.

include!(env!("MBS_MODEL"));
