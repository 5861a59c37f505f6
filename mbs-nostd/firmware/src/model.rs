//! The model: a file by `mbs export SCENE --rust FILE`, which MBS_MODEL names.

include!(env!("MBS_MODEL"));
