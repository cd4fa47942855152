%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%

MODULE MainModule
    ! An older copy: HOME is no part of the loaded program.
    PROC main()
    ENDPROC
ENDMODULE
