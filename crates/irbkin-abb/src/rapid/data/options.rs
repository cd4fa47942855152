//! Names of options and of ABB's own system modules whose arguments are not known.
//!
//! Without another source they are from the word list of KnoP-01/rapid-for-vim, which gives the
//! option of each word. Moves of options are in the table of instructions.

/// Names with arguments that are not known, and whether they are functions.
pub(super) static OPTIONS: [(&str, &str, bool); 14] = [
    // RobotWare; of `FitSphere` there is only a program that calls it.
    (
        "CornerPathWarning FitCircle FitSphere IoCtrlAxis_RefSync IoCtrlAxis_RefSyncOff \
            IoCtrlAxis_RefSyncOn SoftElbow",
        "...",
        false,
    ),
    // `LINKEDM.sys`, which is in backups of IRC5, and `HandDriver.sys` of a YuMi.
    ("Linked_m Linked_m_exe EventLog", "...", false),
    // Conveyor Tracking.
    ("CnvPredictReach GetMaxUsageTime ResetMaxUsageTime UseReachableTargets", "...", false),
    // PickMaster: ABB's `PMppa340.prg` in public repositories.
    ("GetItmTgt QStartItmSrc", "...", false),
    // Palletizing: ABB's `PmMain.mod` and `PmProjServer.mod`, and a list of its PowerPac.
    (
        "PmAckTarget PmCalcArmConf PmCalcIntermid PmErrorLog PmGetFlow PmGetFlowInfo \
            PmGetOperation PmGetProjectInfo PmGetWaInfo PmSetRecoverAction PmStartFlow \
            PmStartProj PmStopFlow PmStopProj PmWaitProjStart",
        "...",
        false,
    ),
    ("PmGetTarget PmGetTgtAction PmSetDefaultHeight", "...", true),
    // Paint.
    ("ConsoleWrite IpsSetParam PntProdUserLog", "...", false),
    (
        "IndexLookup IpsCommand IpsGetParam PaintCommand PntQueueExtraGet PntQueueExtraSet \
            PntQueuePeek",
        "...",
        true,
    ),
    // Tool changers.
    ("TcCloseCover TcDropOffTool TcLockTool TcOpenCover TcPickupTool TcUnlockTool", "...", false),
    // Dispensing.
    ("SyncWWObj", "...", false),
    ("GetSignalDnum", "...", true),
    // Continuous Application Platform.
    ("CapAPTrSetupAI CapAPTrSetupAO CapAPTrSetupPERS CAPSetStopMode", "...", false),
    // Homepos-Running.
    (
        "HR_Exit HR_ExitCycle HR_SavePos HR_SetMoveToStartPos HR_SetTypeDIndex HR_SetTypeIndex",
        "...",
        false,
    ),
    ("HR_GetTypeDIndex HR_GetTypeIndex HR_RobotInHome", "...", true),
];
