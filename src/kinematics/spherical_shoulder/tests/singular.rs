//! At and next to every singularity.
