//! Outlines whose plunges once ended in a refusal of our own: each is cut, and its program accepted.

use cutc::machine::Job;

use crate::support::nests::compiled;
use crate::support::room::Room;

/// An outline in tenths of a millimetre, the settings it was refused with, and why.
const OUTLINES: [(&str, &str, &str); 6] = [
    (
        "a corner is smoothed right behind the plunged tip, which took the blade off its line",
        "--set knife.width_mm=6 --set knife.back_mm=4",
        "H1*G71*N1*M15*M15*X311Y346*M14*X381Y310*X337Y226*X310Y200*X254Y213*X200Y267*X241Y302*X311Y346*M1\
         5*M0*",
    ),
    (
        "a cut that is parted by the range of C ends amid a curve, and turns on by half a chord",
        "--set c.range_deg=[-200,200]",
        "H1*G71*N1*M15*M15*X696Y284*M14*X687Y293*X675Y296*X663Y293*X655Y284*X651Y272*X651Y200*X200Y200*X2\
         00Y1074*X1626Y1074*X1626Y200*X1176Y200*X1176Y276*X1173Y288*X1163Y298*X1151Y301*X1138Y298*X1129Y2\
         88*X1125Y276*X1125Y200*X699Y200*X699Y272*X696Y284*M15*M0*",
    ),
    (
        "a plunge of a nibbled curve cuts nothing that its neighbours do not",
        "--set knife.width_mm=8.89",
        "H1*G71*N1*M15*M15*X1466Y1339*M14*X1469Y1343*X1472Y1346*X1476Y1349*X1480Y1351*X1485Y1352*X1490Y13\
         53*X1495Y1352*X1499Y1351*X1504Y1349*X1508Y1346*X1511Y1343*X1514Y1339*X1516Y1335*X1517Y1330*X1517\
         Y1325*X1812Y1325*X1812Y200*X200Y200*X200Y1325*X495Y1325*X496Y1333*X499Y1340*X504Y1346*X511Y1350*\
         X519Y1352*X526Y1352*X534Y1350*X541Y1346*X546Y1340*X549Y1333*X550Y1325*X817Y1325*X820Y1337*X828Y1\
         347*X839Y1352*X851Y1352*X862Y1347*X870Y1337*X873Y1325*X1145Y1325*X1146Y1332*X1148Y1337*X1152Y134\
         2*X1158Y1346*X1164Y1348*X1171Y1348*X1177Y1346*X1182Y1342*X1186Y1337*X1189Y1332*X1190Y1325*X1462Y\
         1325*X1463Y1330*X1464Y1335*X1466Y1339*M15*M0*",
    ),
    (
        "a ring that is nibbled begins at a station that was counted over a lap",
        r#"--set knife.tight_curves="nibble""#,
        "H1*G71*N1*M15*M15*X889Y931*M14*X891Y930*X893Y929*X895Y927*X896Y925*X965Y456*X965Y454*X964Y451*X9\
         63Y449*X961Y448*X958Y447*X450Y372*X448Y372*X445Y372*X443Y374*X442Y376*X441Y378*X372Y847*X372Y849\
         *X372Y852*X374Y854*X376Y855*X378Y856*X887Y931*X889Y931*M15*X1137Y322*M14*X316Y200*X200Y981*X1021\
         Y1103*X1137Y322*M15*M0*",
    ),
    (
        "a cut that is parted by its length begins where the blade can enter",
        "--set knife.max_down_mm=100",
        "H1*G71*N1*M15*M15*X242Y240*M14*X253Y236*X266Y231*X281Y227*X296Y223*X312Y220*X330Y216*X348Y213*X3\
         67Y210*X387Y208*X408Y206*X429Y204*X451Y202*X473Y201*X495Y201*X517Y200*X540Y200*X563Y200*X585Y201\
         *X607Y202*X629Y203*X651Y205*X671Y207*X692Y209*X711Y212*X730Y215*X748Y218*X765Y221*X781Y225*X795Y\
         229*X809Y233*X821Y238*X832Y242*X842Y247*X850Y252*X857Y257*X862Y262*X866Y267*X868Y273*X869Y278*X8\
         68Y283*X866Y288*X862Y293*X857Y299*X850Y304*X842Y308*X832Y313*X821Y318*X809Y322*X795Y326*X781Y330\
         *X765Y334*X748Y338*X730Y341*X711Y344*X692Y346*X671Y349*X651Y351*X629Y352*X607Y354*X585Y355*X563Y\
         355*X540Y356*X517Y355*X495Y355*X473Y354*X451Y353*X429Y352*X408Y350*X387Y348*X367Y345*X348Y342*X3\
         30Y339*X312Y336*X296Y332*X281Y328*X266Y324*X253Y320*X242Y316*X232Y311*X223Y306*X215Y301*X209Y296\
         *X205Y291*X202Y286*X200Y280*X200Y275*X202Y270*X205Y265*X209Y260*X215Y254*X223Y250*X232Y245*X242Y\
         240*M15*M0*",
    ),
    (
        "the last plunge of the bottom of a notch cuts nothing that the one before does not",
        "--set knife.width_mm=3 --set knife.back_mm=1.5",
        "H1*G91*N1*M15*M15*X2473Y3056*M14*X2107Y2980*X2110Y2969*X2110Y2966*X2109Y2963*X2106Y2961*X2104Y29\
         59*X2100Y2959*X2098Y2961*X2095Y2963*X2094Y2966*X2092Y2977*X1551Y2864*X1600Y2300*X2476Y2300*X2473\
         Y3056*M15*M0*",
    ),
];

#[test]
fn plunges_lie_as_the_verifier_has_them() {
    for (why, settings, outline) in OUTLINES {
        let room = Room::with("outline.cut", outline);
        let said = room.says(&format!("compile outline.cut -t csv {settings}"), 0);
        assert!(said.contains("verified"), "{why}: {said}");
    }
}

/// A blade of 9 mm that cuts a chord of 0.8 mm has its tip beside another line of the same instruction.
#[test]
fn round_notches_of_plots_are_nibbled_with_blades_longer_than_they_are_deep() {
    let plot = "IN;SP1;PU6000,2000;PD9920,2000,9920,2120,9926,2151,9943,2177,9969,2194,10000,2200,10031,2194,10057,2177,\
        10074,2151,10080,2120,10080,2000,14000,2000,14000,6800,6000,6800,6000,2000;PU;SP0;PG;";
    for width in [6.6, 7.5, 7.9, 8.89, 10.0] {
        let mut job = Job::default();
        (job.profile.knife.width_mm, job.profile.knife.back_mm) = (width, Some(6.0));
        compiled(plot, "csv", &job).unwrap_or_else(|why| panic!("{width} mm: {why}"));
    }
}

/// A slit of 30 by 1 units is 3.002 mm long, and begins a tolerance before its edge: between plunge and lift a blade that is
/// hardly shorter has no way to go.
#[test]
fn a_slit_hardly_longer_than_the_blade_is_one_plunge() {
    let mut job = Job::default();
    (job.profile.knife.width_mm, job.profile.knife.back_mm) = (3.002 + job.profile.tolerance(0.1) - 0.001, Some(1.5));
    let slit = "H1*G71*N1*M15*X500Y500*M14*X1500Y500*X1500Y1500*X500Y1500*X500Y500*M15*\
        M19*X1000Y500*M14*X1001Y530*M15*M0*";
    for target in ["csv", "gcode"] {
        let (compiled, _) = compiled(slit, target, &job).unwrap_or_else(|why| panic!("{target}: {why}"));
        // What G-code is moved by says no plunge cuts.
        assert!(matches!(compiled.report.program.plunge_cuts, Some(1) | None), "{target}");
    }
}
