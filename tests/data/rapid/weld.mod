MODULE Weld
  CONST jointtarget jHome:=[[0,-20,20,0,30,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pApproach:=[[120.5,-40,200],[0,0.707106781,0.707106781,0],[0,-1,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pStart:=[[120.5,-40,0],[0,0.707106781,0.707106781,0],[0,-1,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
  CONST robtarget pEnd:=Offs(pStart,0,nLength,0);
  CONST num nLength:=nSeams*80;
  CONST num nSeams:=3;
  ! Corners of the plate.
  CONST pos corners{2,2}:=[[[0,0,0],[400,0,0]],
                           [[0,300,0],[400,300,0]]];
  PERS speeddata vWeld:=[12,500,5000,1000];
  VAR num nDone;
  VAR bool bOk:=TRUE;
  LOCAL VAR robtarget pHere:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];

  PROC main()
    VAR num nLength:=25;
    ConfL\Off;
    SingArea\Wrist;
    MoveAbsJ jHome\NoEOffs, v1000, z50, tTorch\WObj:=wobj0;
    WHILE bOk DO
      seam nLength;
      nDone:=nDone+1;
      IF nDone>=nSeams bOk:=FALSE;
    ENDWHILE
    MoveAbsJ jHome, v1000, fine, tTorch;
  ENDPROC

  PROC seam(num nHeight)
    MoveJ pApproach, v500, z10, tTorch\WObj:=wTable;
    MoveL Offs(pStart,0,0,50), v200, z5, tTorch\WObj:=wTable;
    MoveL pStart, v100, fine, tTorch\WObj:=wTable;
    Set doArc;
    MoveC RelTool(pStart,0,10,5), pEnd, vWeld, z1, tTorch\WObj:=wTable;
    MoveL pEnd, vWeld\V:=8, fine\Inpos:=inpos50, tTorch\WObj:=wTable\TLoad:=ldPart;
    Reset doArc;
    TEST nDone
    CASE 1,2:
      MoveL RelTool(pEnd,0,0,-50\Rz:=15), v200, z5, tTorch\WObj:=wTable;
    DEFAULT:
      MoveJ [[0,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v500, z50, tPointer;
    ENDTEST
  ERROR
    TPWrite "seam "+ValToStr(nDone);
    RETRY;
  ENDPROC

  FUNC bool isThere(robtarget p, \switch Near)
    RETURN p.trans.x>0;
  ENDFUNC
ENDMODULE
