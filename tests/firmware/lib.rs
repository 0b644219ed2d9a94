//! The controller of `cutc track` as a firmware takes it over: with `core` alone.
#![no_std]

#[path = "../../src/track/controller.rs"]
pub mod controller;
