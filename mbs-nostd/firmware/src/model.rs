//! The model: a file that `mbs export SCENE --rust FILE` wrote and MBS_MODEL names.

include!(env!("MBS_MODEL"));
