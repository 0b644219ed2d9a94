//! The text form of marker and toolpath: one line a segment, prints and reads.
