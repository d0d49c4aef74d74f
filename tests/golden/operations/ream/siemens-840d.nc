; program ream, SINUMERIK 840D
; part ream, aluminium, 4 mm thick
; stock 40.00 x 30.00 x 4 mm, from X-20.000 Y-15.000
; origin: axis of the part, Z0 on top of the stock
; pin: D6 H7 [0/+0.012], made to 6.006
; dowel: D6 H7 [0/+0.012], made to 6.006
; drills go 2.04 mm below the stock: leave room under the holes
; reamers go 1.20 mm below the stock: leave room under the holes
; origin G54, Z0 on top of the stock, units mm and mm/min
; T1 D 6 mm: spot-6, spot drill
; T92 D 5.8 mm: drill-5.8, drill
; T91 D 6 mm: reamer-6, reamer
G17 G710 G40 G90 G94 COMPOF
G64
G0 SUPA Z0 D0
; operation: spot drill
T1
M6
G54 S3714 M3
G0 X-10 Y0
D1 Z5
M8
Z1
G1 Z-1.74 F222
G4 F0.2
G0 Z5
X10
Z1
G1 Z-1.74
G4 F0.2
G0 Z5
M9
M5
G0 SUPA Z0 D0
; operation: drill 5.8
T92
M6
G54 S3842 M3
G0 X-10 Y0
D1 Z5
M8
Z1
G1 Z-6.043 F307
G0 Z5
X10
Z1
G1 Z-6.043
G0 Z5
M9
M5
G0 SUPA Z0 D0
; operation: pin: ream
T91
M6
G54 S1061 M3
G0 X-10 Y0
D1 Z5
M8
Z1
G1 Z-5.2 F190
Z1
G0 Z5
; operation: dowel: ream
X10
Z1
G1 Z-5.2
Z1
G0 Z5
M9
M5
G0 SUPA Z0 D0
M30
