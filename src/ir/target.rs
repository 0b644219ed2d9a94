//! Row of a table of targets: a format in which a machine writes its programs.

/// Output format of a machine: a row of its table of targets.
///
/// The row is generic over the writer and the reader of its bytes, because each machine plans a form of its own: a pair of a
/// program and the writer of another machine does not compile. A single function for all machines would take an enumeration
/// of their programs, refuse most of its values, and make every machine import all others.
#[derive(Debug)]
pub struct Target<Emit, Proof> {
    /// Name, as `-t` takes it.
    pub name: &'static str,
    /// Description in a line.
    pub about: &'static str,
    /// Ending of its files, without the first dot.
    pub extension: &'static str,
    /// Writer of its bytes, from a form of the machine.
    pub emit: Emit,
    /// Reader by which the verifier judges its bytes; `None` for pictures and summaries, which show the verdict on another
    /// target.
    pub proof: Option<Proof>,
}
