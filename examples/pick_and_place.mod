MODULE PickAndPlace
    ! A gripper, and a table with a tray on it.
    PERS tooldata tGripper:=[TRUE,[[0,0,180],[1,0,0,0]],[3.2,[0,0,75],[1,0,0,0],0,0,0]];
    PERS wobjdata wTray:=[FALSE,TRUE,"",[[750,-300,420],[1,0,0,0]],[[50,50,25],[0.9659258,0,0,0.2588190]]];

    ! Taught targets.
    CONST robtarget pHome:=[[105.7,323.2,455],[0,0,1,0],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pOverPick:=[[40,-60,120],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pPick:=[[40,-60,8],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

    ! Written by a generator that left confdata at zero.
    CONST robtarget pLift:=[[40,-60,240],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pOverCamera:=[[150,200,260],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pCamera:=[[180,420,180],[0,0.3826834,0.9238795,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pOverPlace:=[[260,560,140],[0,0.7071068,0.7071068,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pPlace:=[[260,560,12],[0,0.7071068,0.7071068,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pTilted:=[[320,300,200],[0.1305262,0,0.9914449,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pReject:=[[1900,0,100],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

    PROC main()
        MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
        MoveJ pHome,v1000,z50,tGripper\WObj:=wTray;
        MoveJ pOverPick,v1000,z20,tGripper\WObj:=wTray;
        MoveL pPick,v100,fine,tGripper\WObj:=wTray;
        SetDO doGrip,1;
        MoveL pLift,v400,z20,tGripper\WObj:=wTray;
        MoveC pOverCamera,pCamera,v400,z10,tGripper\WObj:=wTray;
        MoveJ pOverPlace,v1000,z20,tGripper\WObj:=wTray;
        MoveL pPlace,v100,fine,tGripper\WObj:=wTray;
        MoveL RelTool(pPlace,0,0,-60),v400,z20,tGripper\WObj:=wTray;
        MoveJ pTilted,v1000,z50,tGripper\WObj:=wTray;
        MoveJ pReject,v1000,fine,tGripper\WObj:=wTray;
    ENDPROC
ENDMODULE
